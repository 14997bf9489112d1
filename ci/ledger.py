"""The ledger of claims: definitions and evidence in, verdicts out; nothing here runs anything.

Evidence is what ci/claims gathers:
    tests      program -> {"stale": why or "", "exit_status", "results": {test: passed|failed|skipped}, "figures": [as tests/support/claim.h writes them], "ended"}
    runs       name -> {"stale", "exit_status", "summary": of cipc run, "ended"; "ends": as what the scene's runs are to end, if not "OK"}
    campaigns  name -> {"stale", "exit_status", "report": of cipc verify, "ended"}
    benches    script -> {"stale", "exit_status", "figures": a tree of numbers, "ended"}: ratios of times within one run
    missing pieces are missing keys.
    size       of the scenes; a figure with "sizes" is asked for at these only
    methods    name of a run -> its method, if not "c-ipc"
    all_runs, selected: names of the runs that were to be made; true if those are not all there are. Then claims that need others, or tests that skip for want of them, are open.
A claim has passed only if every piece of evidence it names is there, is of these very programs and inputs, and passed, and every figure is there, once, and lies as it should to its
threshold. What is not shown by anything is open, whatever else has passed.
"""
import json
import math

OF_THE_SPECIFICATION = ["C%d" % k for k in range(1, 15)] + ["A%d" % k for k in range(1, 7)] + ["D%d" % k for k in range(1, 9)] + ["B1", "B2", "B3"]
RELATIONS = {"<": lambda m, t: m < t, "<=": lambda m, t: m <= t, ">": lambda m, t: m > t, ">=": lambda m, t: m >= t, "=": lambda m, t: m == t}
SIZES = ("ci", "desk", "paper")
ANY = "any"  # whose figure a broken line of a log is
SOURCES = {"test": (), "runs": ("violations", "held", "unconverged", "count", "sum", "min", "max"), "campaign": ("counter",), "bench": ("value",)}


class BadDefinition(Exception):
    pass


# ---- Definitions -------------------------------------------------------------------------------------------------------------

def check_figure(where, kind, figure):
    if not figure.get("figure") or "unit" not in figure:
        raise BadDefinition(f"{where}: a figure needs 'figure' and 'unit'")
    if sum(key in figure for key in SOURCES[kind]) != (1 if SOURCES[kind] else 0):
        raise BadDefinition(f"{where}: '{figure['figure']}' needs one of: {', '.join(SOURCES[kind])}")
    relation = figure.get("relation")
    wanted = {"within": {"low", "high"}, None: set()}.get(relation, {"threshold"})
    if relation not in RELATIONS and relation not in ("within", None) or {"low", "high", "threshold"} & set(figure) != wanted:
        raise BadDefinition(f"{where}: '{figure['figure']}': relation {relation!r} and its thresholds do not go together")
    if "sizes" in figure and (kind != "test" or not figure["sizes"] or set(figure["sizes"]) - set(SIZES)):
        raise BadDefinition(f"{where}: '{figure['figure']}': sizes are of {', '.join(SIZES)}, and of a test's figure")
    if kind == "test" and relation is None:
        raise BadDefinition(f"{where}: '{figure['figure']}' of a test has no threshold")


def check_claim(claim, runs):
    where = claim.get("id", "a claim without id")
    if not claim.get("claim") or not claim.get("where"):
        raise BadDefinition(f"{where}: needs 'claim' and 'where'")
    if bool(claim.get("open")) == bool(claim.get("evidence")):
        raise BadDefinition(f"{where}: needs either 'evidence' or, in 'open', the reason why there is none")
    thresholds = 0
    for item in claim.get("evidence", []):
        kinds = [kind for kind in SOURCES if kind in item]
        if len(kinds) != 1:
            raise BadDefinition(f"{where}: a piece of evidence is one of: {', '.join(SOURCES)}")
        for figure in item.get("figures", []):
            check_figure(where, kinds[0], figure)
            thresholds += figure.get("relation") is not None
        unknown = [name for name in item["runs"] if name not in runs] if kinds[0] == "runs" and item["runs"] != "all" else []
        if unknown or item.get("runs") == []:
            raise BadDefinition(f"{where}: no such run: {', '.join(unknown)}")
    if not claim.get("open") and thresholds == 0:
        raise BadDefinition(f"{where}: no figure has a threshold: that shows nothing")


def check(definitions, scenes):
    """scenes: names of the catalogue. BadDefinition with the place."""
    extra = [run["name"] for run in definitions["runs"]]
    for run in definitions["runs"]:
        if run["scene"] not in scenes:
            raise BadDefinition(f"run {run['name']}: no scene {run['scene']}")
    if len(set(extra)) != len(extra) or set(extra) & set(scenes):
        raise BadDefinition("two runs have the same name")
    ids = []
    for paper in definitions["papers"]:
        for claim in paper["claims"]:
            check_claim(claim, extra + list(scenes))
            ids.append(claim["id"])
    if len(set(ids)) != len(ids):
        raise BadDefinition("two claims have the same id")
    lost = [name for name in OF_THE_SPECIFICATION if name not in {i.split()[0] for i in ids}]
    if lost:
        raise BadDefinition(f"claims without a row: {', '.join(lost)}")


# ---- Verdicts ----------------------------------------------------------------------------------------------------------------

def number(value):
    """A double as cipc writes it: a number, or "inf", "-inf", "nan"; None if it is neither."""
    if isinstance(value, bool) or value is None:
        return None
    try:
        return float(value)
    except (TypeError, ValueError):
        return None


def lies_right(figure, measured):
    if figure.get("relation") is None:
        return True
    if figure["relation"] == "within":
        return figure["low"] < measured < figure["high"]
    return RELATIONS[figure["relation"]](measured, figure["threshold"])


def threshold_text(figure):
    if figure.get("relation") is None:
        return ""
    if figure["relation"] == "within":
        return f"{figure['low']:.6g} to {figure['high']:.6g}"
    return f"{figure['relation']} {figure['threshold']:.6g}"


def take(figure, measured, reasons, where):
    """The figure with what was measured; complains when there is nothing, when it is not finite, or lies wrong."""
    if measured is None or not math.isfinite(measured):
        reasons.append(f"{where}: no figure '{figure['figure']}'" + ("" if measured is None else f": {measured}"))
        measured = None
    elif not lies_right(figure, measured):
        reasons.append(f"{where}: '{figure['figure']}' is {measured:.17g}, asked for: {threshold_text(figure)}")
    return {**figure, "measured": measured}


def ended_wrong(ends, exit_status, summary):
    """Why a run did not end as it is to; "": it did. A scene that is to stall (`ends`, of the catalogue) has to: neither may it come to its end, nor say that it had."""
    if ends == "OK":
        return "" if exit_status == 0 else f"exit status {exit_status}"
    if exit_status != 1:
        return f"exit status {exit_status}, but it is to end as {ends}, with 1"
    status, taken, asked = summary.get("status"), summary.get("steps_taken"), summary.get("steps_asked")
    if status != ends or summary.get("exit_status") != 1 or summary.get("converged") is not False or taken is None or asked is None or not 0 < taken < asked:
        return f"{status} after {taken} of {asked} steps, but it is to end as {ends} on the way"
    return ""


def problems(piece, name):
    """Why a piece of evidence does not count."""
    if piece is None:
        return [f"{name}: has not run"]
    if piece["stale"]:
        return [f"{name}: is of another time: {piece['stale']}"]
    wrong = ended_wrong(piece.get("ends", "OK"), piece["exit_status"], piece.get("summary") or {})
    return [f"{name}: {wrong}"] if wrong else []


def same_threshold(figure, record):
    return figure["relation"] == record.get("relation") and all(figure.get(key) == number(record.get(key)) for key in ("threshold", "low", "high") if key in figure)


def judge_test(claim, item, evidence, reasons):
    program = item["test"]
    piece = evidence["tests"].get(program)
    wrong = problems(piece, program)
    reasons += wrong
    results = piece["results"] if piece else {}
    if piece and not item.get("names") and (not results or "passed" not in results.values()):
        reasons.append(f"{program}: no test of it has run")
    if piece and not item.get("names"):
        reasons += [f"{program}: {name} was skipped" for name, result in results.items() if result == "skipped"]
    for name in item.get("names", []):
        if piece and results.get(name) != "passed":
            reasons.append(f"{program}: {name} " + {"failed": "failed", "skipped": "was skipped"}.get(results.get(name), "has not run"))
    records = [r for r in piece["figures"] if r.get("claim") in (claim["id"], ANY)] if piece else []
    asked = [f for f in item.get("figures", []) if evidence["size"] in f.get("sizes", SIZES)]
    named = {f["figure"] for f in asked}
    reasons += [f"{program}: reports '{r.get('figure')}', which ci/claims.json does not name" for r in records if r.get("figure") not in named]
    figures = []
    for figure in asked:
        mine = [r for r in records if r["figure"] == figure["figure"]]
        if len(mine) > 1:
            reasons.append(f"{program}: reports '{figure['figure']}' {len(mine)} times")
        if mine and not same_threshold(figure, mine[0]):
            reasons.append(f"{program}: asks another threshold of '{figure['figure']}' than ci/claims.json")
        figures.append(take(figure, number(mine[0].get("measured")) if mine and not wrong else None, reasons, program))
    return figures, [piece["ended"]] if piece else []


def at(tree, path):
    for key in path.split("."):
        tree = tree.get(key) if isinstance(tree, dict) else None
    return tree


def violated(summary, monitor):
    return at(summary, f"invariants.{monitor}") == "violated"


def judge_run(item, name, piece, reasons):
    """A run must have ended as it is to, and the monitors must have looked and found nothing."""
    wrong = problems(piece, f"run {name}")
    summary = piece.get("summary") if piece else None
    if piece and not summary:
        wrong.append(f"run {name}: has left no summary")
    if summary:
        stalls = piece.get("ends", "OK") != "OK"
        if not stalls and summary.get("status") != "OK":
            wrong.append(f"run {name}: {summary.get('status')}: {at(summary, 'error.what')}")
        if not stalls and (summary.get("steps_taken") != summary.get("steps_asked") or summary.get("converged") is not True):
            wrong.append(f"run {name}: {summary.get('steps_taken')} of {summary.get('steps_asked')} steps, converged: {summary.get('converged')}")
        monitors = [item["monitor"]] if isinstance(item["monitor"], str) else item["monitor"]
        for monitor in monitors:
            verdict = at(summary, f"invariants.{monitor}")
            nothing_there = item.get("unless") == "no limit" and verdict == "not checked" and number(at(summary, "extremes.max_stretch_ratio")) == 0
            if verdict != "holds" and not nothing_there:
                wrong.append(f"run {name}: {monitor}: {verdict}")
    reasons += wrong
    return summary


def of_runs(figure, summaries):
    if "count" in figure:
        return float(len(summaries))
    if "violations" in figure:
        return float(sum(violated(s, figure["violations"]) for s in summaries))
    if "held" in figure:
        return float(sum(at(s, f"invariants.{figure['held']}") == "holds" for s in summaries))
    if "unconverged" in figure:
        return float(sum(s["steps_asked"] - s["steps_taken"] + (s["converged"] is not True) for s in summaries))
    way = next(key for key in ("sum", "min", "max") if key in figure)
    values = [number(at(s, figure[way])) for s in summaries]
    return None if None in values or not values else {"sum": math.fsum, "min": min, "max": max}[way](values)


def judge_runs(item, evidence, reasons):
    names = evidence["runs_of_paper"] if item["runs"] == "all" else item["runs"]
    if not names:
        reasons.append("no run at all")
    pieces = [evidence["runs"].get(name) for name in names]
    summaries = [judge_run(item, name, piece, reasons) for name, piece in zip(names, pieces)]
    found = [s for s in summaries if s]
    figures = [take(figure, of_runs(figure, found) if found else None, reasons, "the runs") for figure in item.get("figures", [])]
    return figures, [p["ended"] for p in pieces if p]


def judge_campaign(item, evidence, reasons):
    name = item["campaign"]
    piece = evidence["campaigns"].get(name)
    where = f"campaign {name}"
    reasons += problems(piece, where)
    report = (piece or {}).get("report") or {}
    if piece and report.get("verdict") != "passed":
        reasons.append(f"{where}: verdict {report.get('verdict')}")
    counts = {}
    for campaign in report.get("campaigns", []):
        for row in campaign["rows"] if campaign["campaign"] == name else []:
            for counter in row["counters"]:
                counts[counter["name"]] = counts.get(counter["name"], 0) + counter["count"]
    figures = [{"figure": "queries", "unit": "1", "measured": number(report.get("samples"))}]
    figures += [take(figure, number(counts.get(figure["counter"])), reasons, where) for figure in item.get("figures", [])]
    return figures, [piece["ended"]] if piece else []


def judge_bench(item, evidence, reasons):
    script = item["bench"]
    piece = evidence["benches"].get(script)
    wrong = problems(piece, script)
    reasons += wrong
    measured = (piece.get("figures") if piece and not wrong else None) or {}
    return [take(figure, number(at(measured, figure["value"])), reasons, script) for figure in item.get("figures", [])], [piece["ended"]] if piece else []


def left_out(claim, evidence):
    """Why a claim is not judged when only some runs were asked for; "": it is."""
    for item in claim["evidence"] if evidence.get("selected") else []:
        if "runs" in item and item["runs"] != "all":
            absent = [name for name in item["runs"] if name not in evidence["all_runs"]]
            if absent:
                return "not among the selected runs: " + ", ".join(f"`{name}`" for name in absent)
        results = (evidence["tests"].get(item.get("test")) or {}).get("results", {})
        skipped = [name for name in item.get("names", []) if results.get(name) == "skipped"]
        if skipped:
            return "what it measures is not among the selected runs: " + ", ".join(f"`{name}`" for name in skipped)
    return ""


def has_failed(claim, evidence):
    """Does anything of what is there speak against the claim? Then leaving out the rest does not make it open."""
    for item in claim["evidence"]:
        piece = evidence["tests"].get(item.get("test"))
        if piece and (piece["exit_status"] != 0 or "failed" in [piece["results"].get(name) for name in item.get("names", [])]):
            return True
        reasons = []
        for name in item["runs"] if isinstance(item.get("runs"), list) else []:
            if name in evidence["runs"]:
                judge_run(item, name, evidence["runs"][name], reasons)
        if reasons:
            return True
    return False


def judge_claim(claim, evidence):
    row = {"id": claim["id"], "claim": claim["claim"], "where": claim["where"], "figures": [], "shown_by": [], "reasons": [], "date": ""}
    if not claim.get("evidence"):
        return {**row, "verdict": "open", "reasons": [claim["open"]]}
    absent = left_out(claim, evidence)
    if absent and not has_failed(claim, evidence):
        return {**row, "verdict": "open", "reasons": [absent]}
    ended = []
    for item in claim["evidence"]:
        if "test" in item:
            figures, dates = judge_test(claim, item, evidence, row["reasons"])
        elif "runs" in item:
            figures, dates = judge_runs(item, evidence, row["reasons"])
        elif "bench" in item:
            figures, dates = judge_bench(item, evidence, row["reasons"])
        else:
            figures, dates = judge_campaign(item, evidence, row["reasons"])
        row["figures"] += figures
        row["shown_by"].append(shown_by(item))
        ended += dates
    row["date"] = min(ended)[:10] if ended else ""
    return {**row, "verdict": "failed" if row["reasons"] else "passed"}


def of_method(method, evidence):
    """The names of the runs that are made by a paper's method: what "all" means there. None: the paper's is not here."""
    return [name for name in evidence["all_runs"] if evidence.get("methods", {}).get(name, "c-ipc") == method]


def judge(definitions, evidence):
    return [{"name": paper["name"], "short": paper["short"], "source": paper["source"],
             "claims": [judge_claim(claim, {**evidence, "runs_of_paper": of_method(paper.get("method"), evidence)}) for claim in paper["claims"]]}
            for paper in definitions["papers"]]


def counts(papers):
    verdicts = [claim["verdict"] for paper in papers for claim in paper["claims"]]
    return {word: verdicts.count(word) for word in ("passed", "failed", "open")}


# ---- The page, and JUnit -----------------------------------------------------------------------------------------------------

BEGIN, END = "<!-- ledger: make claims -->", "<!-- end of ledger -->"


def shown_by(item):
    if "test" in item:
        text = f"`{item['test']}.c`" + (": " + ", ".join(f"`{name}`" for name in item["names"]) if item.get("names") else "")
    elif "runs" in item:
        text = "every scene and variant" if item["runs"] == "all" else "runs " + ", ".join(f"`{name}`" for name in item["runs"])
    elif "bench" in item:
        text = "`" + " ".join([item["bench"], "build/cipc", *item.get("arguments", [])]) + "`"
    else:
        text = f"`cipc verify {item['campaign']}`"
    return text + (f" ({item['shows']})" if item.get("shows") else "")


def figure_cells(figure):
    unit = "" if figure["unit"] == "1" else " " + figure["unit"]
    measured = "none" if figure["measured"] is None else f"{figure['measured']:,.0f}" if figure["measured"] == int(figure["measured"]) else f"{figure['measured']:.6g}"
    return [figure["figure"], measured + unit, threshold_text(figure)]


def claim_lines(row):
    shown = "; ".join(row["shown_by"]) if row["verdict"] != "open" else row["reasons"][0]
    first = [row["id"], row["claim"], row["where"], shown]
    last = [row["verdict"], row["date"]]
    figures = [figure_cells(f) for f in row["figures"]] or [["", "", ""]]
    lines = [first + figures[0] + last] + [[""] * 4 + cells + ["", ""] for cells in figures[1:]]
    return ["| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |" for cells in lines]


def tables(head, papers):
    total = counts(papers)
    lines = [f"{total['passed']} passed, {total['failed']} failed, {total['open']} open. Size `{head['size']}`, {head['date']}, commit {head['commit']}, {head['machine']}."]
    if head.get("selected"):
        lines += ["", "Only these runs were made, and \"every scene and variant\" below is these: " + ", ".join(f"`{name}`" for name in head["selected"]) + "."]
    for paper in papers:
        lines += ["", f"## {paper['name']}", "", f"{paper['source']}.", "", "| | claim | in the paper | shown by | figure | measured | threshold | verdict | date |", "|" + " --- |" * 9]
        for row in paper["claims"]:
            lines += claim_lines(row)
        failed = [row for row in paper["claims"] if row["verdict"] == "failed"]
        if failed:
            lines += ["", "What failed:", ""] + [f"- {row['id']}: {reason}" for row in failed for reason in row["reasons"]]
    return "\n".join(lines)


def page(template, head, papers):
    """The template with its tables replaced; ValueError without the two markers."""
    if template.count(BEGIN) != 1 or template.count(END) != 1 or template.index(BEGIN) > template.index(END):
        raise ValueError(f"lacks the markers '{BEGIN}' and '{END}'")
    before, rest = template.split(BEGIN)
    return before + BEGIN + "\n" + tables(head, papers) + "\n" + END + rest.split(END)[1]


def report(head, papers):
    return json.dumps({**head, "counts": counts(papers), "papers": papers}, indent=1) + "\n"


def suites(papers, case):
    """For ci/junit.py: a suite per paper, a case per claim."""
    outcome = {"passed": "passed", "failed": "failed", "open": "skipped"}
    return [(paper["short"], [case(f"{row['id']}: {row['claim']}", outcome[row["verdict"]], "; ".join(row["reasons"][:1]), "\n".join(row["reasons"][1:])) for row in paper["claims"]])
            for paper in papers]
