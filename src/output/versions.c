/* Versions of everything that has a say in a result. */
#include "output/versions.h"
#include "base/json_number.h"

#include <cairo.h>
#include <cholmod.h>
#include <gmp.h>
#include <gnu/libc-version.h>
#include <gsl/gsl_version.h>
#include <hdf5.h>
#include <mpfr.h>
#include <stdio.h>
#include <sys/utsname.h>
#include "cipc/base.h"

#if defined(__clang__)
static const char compiler[] = "clang " __clang_version__;
#else
static const char compiler[] = "gcc " __VERSION__;
#endif

static json_t *triple(unsigned major, unsigned minor, unsigned patch)
{
    char text[64];
    snprintf(text, sizeof text, "%u.%u.%u", major, minor, patch);
    return json_string(text);
}

static json_t *platform(void)
{
    struct utsname name;
    if (uname(&name) != 0) {
        return json_string("unknown");
    }
    return json_sprintf("%s %s %s", name.sysname, name.release, name.machine);
}

json_t *cipc_versions(void)
{
    bool good = true;
    unsigned major = 0, minor = 0, patch = 0;
    H5get_libversion(&major, &minor, &patch);
    json_t *versions = json_object();
    cipc_json_put(versions, "cipc", json_string(cipc_version()), &good);
    cipc_json_put(versions, "compiler", json_string(compiler), &good);
    cipc_json_put(versions, "platform", platform(), &good);
    cipc_json_put(versions, "glibc", json_string(gnu_get_libc_version()), &good);
    cipc_json_put(versions, "cholmod", triple(CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION), &good);
    cipc_json_put(versions, "gmp", json_string(gmp_version), &good);
    cipc_json_put(versions, "mpfr", json_string(mpfr_get_version()), &good);
    cipc_json_put(versions, "gsl", json_string(gsl_version), &good);
    cipc_json_put(versions, "hdf5", triple(major, minor, patch), &good);
    cipc_json_put(versions, "jansson", json_string(jansson_version_str()), &good);
    cipc_json_put(versions, "cairo", json_string(cairo_version_string()), &good);
    if (!good) {
        json_decref(versions);
        return NULL;
    }
    return versions;
}
