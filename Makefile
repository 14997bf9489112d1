# The build of cipc. `make help` lists the targets; README.md says what they are for.
#
# One source, one object (position independent), used by the program, both libraries and every test program. Anything that
# changes an object - compiler, flags, headers - rebuilds it; adding or removing a source file rebuilds what it is linked into.

BUILD  ?= build
PREFIX ?= /usr/local
ifeq ($(origin CC),default)
CC := gcc
endif

VERSION := $(shell sed -n 's/.*return "\([0-9.]*\)".*/\1/p' src/base/version.c)
SOMAJOR := $(firstword $(subst ., ,$(VERSION)))
SONAME  := libcipc.so.$(SOMAJOR)

# The demonstration, exactly as a user would type it.
DEMO = $(BUILD)/cipc run tests/scenes/drape.json --set size=demo -o $(BUILD)/demo

# ---- Flags ------------------------------------------------------------------------------------------------------------------
# Reproducible results: no -ffast-math, no fused multiply-add by contraction, and no code for this machine only unless
# ARCH=native asks for it. -fno-math-errno and -fno-semantic-interposition change speed, never a result.
WERROR   ?= -Werror
WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wvla $(WERROR)
OPTIMIZE ?= -O3 -g

PACKAGES := $(shell pkg-config --exists hdf5-serial 2>/dev/null && echo hdf5-serial || echo hdf5) jansson cairo mpfr gmp qhull_r
# The libraries' headers are system headers: their warnings are not ours to mend.
PACKAGE_CFLAGS := $(patsubst -I%,-isystem %,$(shell pkg-config --cflags $(PACKAGES) 2>/dev/null)) -isystem /usr/include/suitesparse
# GSL takes its CBLAS from BLAS, so that one BLAS serves GSL, LAPACK and CHOLMOD alike.
PACKAGE_LIBS := $(shell pkg-config --libs $(PACKAGES) 2>/dev/null) -lgsl -lcholmod -lsuitesparseconfig -llapacke -llapack -lblas -lm

ALL_CFLAGS  = -std=c17 -D_DEFAULT_SOURCE $(OPTIMIZE) $(WARNINGS) -ffp-contract=off -fno-math-errno -fno-semantic-interposition \
              -fPIC -fopenmp $(if $(ARCH),-march=$(ARCH)) -Iinclude -Isrc $(PACKAGE_CFLAGS) $(CFLAGS)
ALL_LDFLAGS = -fopenmp $(LDFLAGS)
SHARED_LDFLAGS ?= -Wl,-z,defs
# Test programs count the allocations of the library and can make the N-th one fail (tests/support/failing_memory.h).
TEST_LDFLAGS := -Wl,--wrap=calloc,--wrap=realloc

# ---- Files ------------------------------------------------------------------------------------------------------------------
object = $(patsubst %.c,$(BUILD)/obj/%.o,$(1))

LIBRARY_SOURCES := $(filter-out src/cli/%,$(wildcard src/*/*.c))
CLI_SOURCES     := $(filter-out src/cli/main.c,$(wildcard src/cli/*.c))
MAIN_SOURCE     := $(wildcard src/cli/main.c)
SUPPORT_SOURCES := $(wildcard tests/support/*.c)
TEST_SOURCES    := $(wildcard tests/*/test_*.c)
SOURCES         := $(wildcard bench/*.c) $(LIBRARY_SOURCES) $(CLI_SOURCES) $(MAIN_SOURCE) $(SUPPORT_SOURCES) $(TEST_SOURCES)
HEADERS         := $(wildcard include/cipc/*.h)

PROGRAM := $(if $(MAIN_SOURCE),$(BUILD)/cipc)
STATIC  := $(BUILD)/libcipc.a
SHARED  := $(BUILD)/libcipc.so
# Not installed: the command line without main(), and the code that tests share.
CLI_ARCHIVE  := $(BUILD)/obj/libcli.a
TEST_SUPPORT := $(BUILD)/obj/libsupport.a
TESTS := $(patsubst %.c,$(BUILD)/%,$(TEST_SOURCES))

# ---- Targets for people -----------------------------------------------------------------------------------------------------
.PHONY: help all deps deps-all demo check verify validation claims golden mutants nightly coverage sanitize valgrind lint bench format install uninstall clean
.DEFAULT_GOAL := all

# A plain `make check` uses every core; an explicit -j is respected.
SUBMAKE = +@$(MAKE) --no-print-directory $(if $(findstring -j,$(MAKEFLAGS)),,-j$(shell nproc 2>/dev/null || echo 1))

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/\1\t\2/p' Makefile | while IFS='	' read -r target text; do printf '  make %-10s %s\n' "$$target" "$$text"; done
	@printf '\nVariables: CC=gcc|clang  BUILD=dir (now %s)  CFLAGS=, LDFLAGS= (added to ours)  ARCH=native  PREFIX=, DESTDIR=  V=1 (show commands)\n' '$(BUILD)'
	@printf 'One test program: make %s/tests/unit/test_status && %s/tests/unit/test_status\n' '$(BUILD)' '$(BUILD)'

all: $(PROGRAM) $(STATIC) $(SHARED) ## the program build/cipc and the libraries build/libcipc.a and .so (the default)

deps: ## install the Debian packages that the build, the tests and the demo need, with sudo when not root; nothing when all are there
	@ci/install-deps

deps-all: ## the same, and the packages of coverage, sanitize, valgrind, lint, format, the plots of validation and CC=clang
	@ci/install-deps --all

demo: ## install what is missing, build, run the drape scene into build/demo and say where the pictures are
	@ci/install-deps
	$(SUBMAKE) all
	@echo '$(DEMO)'; $(DEMO)
	@printf '\nPictures:\n'; ls $(BUILD)/demo/*.png | sed 's/^/  /'
	@printf 'ParaView opens %s; the verdict of every invariant is in %s.\n' '$(BUILD)/demo/trajectory.xdmf' '$(BUILD)/demo/summary.json'

check: ## install what is missing, build, run every test; the last line is "N passed, N failed, N skipped"
	@ci/install-deps
	$(SUBMAKE) verdict

# The campaigns in the test run take about a minute of two cores, this some ten; SAMPLES=, SEED= for more and others.
SAMPLES ?= 1000000
SEED    ?= 1
PUBLIC_QUERIES := $(wildcard ../shared/data/ccd)
verify: ## the functions of the solver against exact and MPFR arithmetic: a large campaign (SAMPLES=1000000), report in build/verify.json
	$(SUBMAKE) all
	$(BUILD)/cipc verify all --samples $(SAMPLES) --seed $(SEED) --threads $(shell nproc 2>/dev/null || echo 1) --json $(BUILD)/verify.json \
	    --worst $(BUILD)/verify-worst.jsonl $(if $(PUBLIC_QUERIES),--data $(PUBLIC_QUERIES))

VALIDATION_PAGE   ?= docs/validation.md
VALIDATION_IMAGES ?= docs/images
VALIDATION_TESTS  := $(addprefix tests/scenes/test_,plane rods shells volumes hertz locking splitting stack) \
    $(addprefix tests/asynchronous/test_,impact collision resting events energy friction damping) tests/massspring/test_iterations
validation: ## physics against closed forms: run their tests, write the table and the plots of docs/validation.md
	$(SUBMAKE) all $(VALIDATION_TESTS:%=$(BUILD)/%)
	@rm -f $(BUILD)/validation.tsv
	@for t in $(VALIDATION_TESTS); do CIPC_VALIDATION=$(BUILD)/validation.tsv $(BUILD)/$$t >/dev/null 2>$(BUILD)/validation.log || { cat $(BUILD)/validation.log; exit 1; }; done
	@ci/validation $(BUILD)/validation.tsv $(VALIDATION_PAGE) $(VALIDATION_IMAGES)

SIZE ?= ci
claims: ## run what shows the papers' claims (SIZE=ci; desk and paper take hours; RUNS="a b": only these; PAGE=FILE), write docs/claims.md, build/claims.json, build/claims.xml
	$(SUBMAKE) all $$(ci/claims --programs --build $(BUILD))
	@ci/claims --build $(BUILD) --size $(SIZE) $(if $(RUNS),--select '$(RUNS)') $(if $(PAGE),--page $(PAGE))

golden: ## make the golden files anew: SCENES="a b" or all; prints what changed, refuses where an invariant fails (tests/golden/README.md)
	$(SUBMAKE) all $(BUILD)/tests/scenes/test_scenes
	@ci/golden $(BUILD) $(SCENES)

mutants: ## plant every fault of ci/mutants.list and see the named check reject it; docs/mutants.md
	$(SUBMAKE) all tests
	@ci/mutants --build $(BUILD)

nightly: ## the long stages one after another: validation, a large verification, the scenes at size desk, claims, all mutants; hours
	@ci/nightly --build $(BUILD)

COVERAGE_FLAGS := --coverage -fprofile-update=atomic
coverage: ## line coverage per folder of src/; fails below 95 % in geometry, energy, contact and implicit (build/coverage)
	@find $(BUILD)/coverage -name '*.gcda' -delete 2>/dev/null || true # counts of earlier runs
	$(SUBMAKE) verdict BUILD=$(BUILD)/coverage CC=gcc CHECKS="'tests/conformance/check $(BUILD)/coverage'" WERROR= OPTIMIZE='-O1 -g' CFLAGS='$(COVERAGE_FLAGS) $(CFLAGS)' \
	    LDFLAGS='$(COVERAGE_FLAGS) $(LDFLAGS)'
	@ci/coverage $(BUILD)/coverage

SANITIZE_FLAGS := -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
sanitize: export LSAN_OPTIONS = suppressions=$(CURDIR)/ci/lsan.supp:print_suppressions=0
sanitize: ## every test under the address and undefined-behaviour sanitizers (build/sanitize)
	$(SUBMAKE) verdict BUILD=$(BUILD)/sanitize CHECKS= WERROR= OPTIMIZE='-O1 -g' CFLAGS='$(SANITIZE_FLAGS) $(CFLAGS)' \
	    LDFLAGS='$(SANITIZE_FLAGS) $(LDFLAGS)' SHARED_LDFLAGS=

valgrind: ## some unit tests and a short run under valgrind's memcheck
	$(SUBMAKE) all tests
	@ci/valgrind $(BUILD)

lint: ## cppcheck over src and include
	@# uninitvar: cppcheck does not see that a function fills the row of a matrix handed to it; valgrind looks for the same at run time
	cppcheck --quiet --std=c11 --enable=warning,performance,portability --inline-suppr --suppress=uninitvar --error-exitcode=1 \
	    --library=ci/cppcheck.cfg -Iinclude -Isrc src

bench: ## build, then run the benchmarks (bench/run); BENCH=full for the long list; never part of a verdict
	$(SUBMAKE) all benches
	@BUILD=$(BUILD) bench/run $(BENCH)

format: ## lay out all sources with clang-format
	clang-format -i $(wildcard src/*/*.[ch] include/cipc/*.h tests/*/*.[ch])

clean: ## remove the build folder
	rm -rf $(BUILD)

# ---- Installation -----------------------------------------------------------------------------------------------------------
BINDIR     = $(DESTDIR)$(PREFIX)/bin
LIBDIR     = $(DESTDIR)$(PREFIX)/lib
INCLUDEDIR = $(DESTDIR)$(PREFIX)/include/cipc
MANDIR     = $(DESTDIR)$(PREFIX)/share/man/man1

define PKGCONFIG
prefix=$(PREFIX)
libdir=$${prefix}/lib
includedir=$${prefix}/include

Name: cipc
Description: codimensional incremental potential contact, reference implementation and verification
Version: $(VERSION)
Requires.private: $(PACKAGES) gsl
Libs: -L$${libdir} -lcipc
Libs.private: -lcholmod -llapacke -llapack -lblas -lm -fopenmp
Cflags: -I$${includedir}
endef

install: all ## install program, libraries, headers, cipc.pc and the manual page under PREFIX (DESTDIR is honoured)
	$(SUBMAKE) install-files

.PHONY: install-files
install-files:
	install -d $(BINDIR) $(LIBDIR)/pkgconfig $(INCLUDEDIR) $(MANDIR)
	$(if $(PROGRAM),install -m 755 $(PROGRAM) $(BINDIR))
	install -m 644 $(STATIC) $(LIBDIR)
	install -m 755 $(SHARED) $(LIBDIR)/libcipc.so.$(VERSION)
	ln -sf libcipc.so.$(VERSION) $(LIBDIR)/$(SONAME)
	ln -sf $(SONAME) $(LIBDIR)/libcipc.so
	install -m 644 $(HEADERS) $(INCLUDEDIR)
	install -m 644 docs/cipc.1 $(MANDIR)
	$(file >$(BUILD)/cipc.pc,$(PKGCONFIG))install -m 644 $(BUILD)/cipc.pc $(LIBDIR)/pkgconfig

uninstall: ## remove what install has put there
	rm -f $(BINDIR)/cipc $(LIBDIR)/libcipc.a $(LIBDIR)/libcipc.so $(LIBDIR)/$(SONAME) $(LIBDIR)/libcipc.so.$(VERSION)
	rm -f $(patsubst include/cipc/%,$(INCLUDEDIR)/%,$(HEADERS)) $(MANDIR)/cipc.1 $(LIBDIR)/pkgconfig/cipc.pc
	-rmdir $(INCLUDEDIR) 2>/dev/null

# ---- Tests ------------------------------------------------------------------------------------------------------------------
.PHONY: tests verdict
tests: $(TESTS)

# Scripts that pass or fail as a whole; they count as one test each.
CHECKS := 'ci/check-layers' 'ci/check-layers --self-test' 'ci/check-symbols $(BUILD)' 'ci/check-symbols --self-test' \
    $(if $(PROGRAM),'ci/check-docs $(BUILD)') 'ci/check-docs --self-test' 'ci/check-install $(BUILD)' 'ci/run-tests --self-test' \
    'tests/conformance/check $(BUILD)' 'tests/conformance/check-verify $(BUILD)' 'ci/mutants --self-test' 'ci/mutants --fast --build $(BUILD)' \
    'ci/check-gappa' 'ci/check-gappa --self-test' 'ci/validation --self-test' 'ci/golden --self-test' 'ci/scene-costs --self-test' \
    $(if $(PROGRAM),'ci/claims --check --build $(BUILD)') 'ci/claims --self-test' 'ci/nightly --self-test' \
    $(if $(PROGRAM),'ci/scene-page --check $(BUILD)/cipc') 'ci/scene-page --self-test'

verdict: all tests
	@CIPC=$(BUILD)/cipc ci/run-tests $(BUILD)/tests $(CHECKS) $(TESTS)

$(TESTS): $(BUILD)/%: $(BUILD)/obj/%.o $(CLI_ARCHIVE) $(STATIC) $(TEST_SUPPORT)
	@mkdir -p $(@D)
	$(call say,LD,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $(TEST_LDFLAGS) -o $@ $< -Wl,--start-group $(CLI_ARCHIVE) $(STATIC) $(TEST_SUPPORT) -Wl,--end-group \
	    $(PACKAGE_LIBS) -lcmocka

# ---- Benchmarks -------------------------------------------------------------------------------------------------------------
BENCHES := $(patsubst %.c,$(BUILD)/%,$(wildcard bench/*.c))
.PHONY: benches
benches: $(BENCHES)

$(BENCHES): $(BUILD)/%: $(BUILD)/obj/%.o $(STATIC)
	@mkdir -p $(@D)
	$(call say,LD,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) -o $@ $^ $(PACKAGE_LIBS)

# ---- Libraries and program --------------------------------------------------------------------------------------------------
Q   = $(if $(V),,@)
say = @$(if $(V),:,printf '  %-3s %s\n' '$(1)' '$(2)')

define archive
	@mkdir -p $(@D)
	$(call say,AR,$@)
	$(Q)rm -f $@ && $(AR) rcsD $@ $(filter %.o,$^)
endef

$(STATIC): $(call object,$(LIBRARY_SOURCES)) $(BUILD)/obj/sources
	$(archive)
$(CLI_ARCHIVE): $(call object,$(CLI_SOURCES)) $(BUILD)/obj/sources
	$(archive)
$(TEST_SUPPORT): $(call object,$(SUPPORT_SOURCES)) $(BUILD)/obj/sources
	$(archive)

$(SHARED): $(call object,$(LIBRARY_SOURCES)) $(BUILD)/obj/sources
	$(call say,LD,$@)
	$(file >$(BUILD)/obj/exports,{ global: cipc_*; local: *; };)
	$(Q)$(CC) $(ALL_LDFLAGS) $(SHARED_LDFLAGS) -shared -Wl,-soname,$(SONAME),--version-script,$(BUILD)/obj/exports -o $@ $(filter %.o,$^) $(PACKAGE_LIBS)
	@ln -sf libcipc.so $(BUILD)/$(SONAME)

$(BUILD)/cipc: $(call object,$(MAIN_SOURCE)) $(CLI_ARCHIVE) $(STATIC)
	$(call say,LD,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) -o $@ $^ $(PACKAGE_LIBS)

$(BUILD)/obj/%.o: %.c $(BUILD)/obj/command
	@mkdir -p $(@D)
	$(call say,CC,$<)
	$(Q)$(CC) $(ALL_CFLAGS) $(if $(filter tests/%,$<),-Itests) -MMD -MP -c -o $@ $<

# Two stamps, rewritten only when their content changes: the command line with the compiler's version, and the list of sources.
.PHONY: FORCE
stamp = mkdir -p $(@D); printf '%s\n' '$(1)' | cmp -s - $@ || printf '%s\n' '$(1)' >$@

$(BUILD)/obj/command: FORCE
	@ci/install-deps --check
	@$(call stamp,$(shell $(CC) --version 2>&1 | head -n 1) | $(CC) $(ALL_CFLAGS) | $(ALL_LDFLAGS) $(PACKAGE_LIBS))

$(BUILD)/obj/sources: FORCE
	@$(call stamp,$(LIBRARY_SOURCES) $(CLI_SOURCES) $(SUPPORT_SOURCES))

-include $(patsubst %.c,$(BUILD)/obj/%.d,$(SOURCES))
