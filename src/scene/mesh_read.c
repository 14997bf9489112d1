/* Mesh files by the ending of their name. */
#include <string.h>
#include <strings.h>

#include "scene/mesh_formats.h"
#include "scene/text_file.h"

typedef enum file_format { FORMAT_OBJ, FORMAT_SEG, FORMAT_GMSH, FORMAT_VTK, FORMAT_COUNT } file_format;

static file_format format_of(const char *path)
{
    static const char *const endings[] = {".obj", ".seg", ".msh", ".vtk"};
    const char *ending = strrchr(path, '.');
    int format = 0;
    while (format < FORMAT_COUNT && (ending == NULL || strcasecmp(ending, endings[format]) != 0)) format++;
    return (file_format)format;
}

/* Binary data nearly always has a zero byte, which would end the text early: said here, in words that help. */
static cipc_status check_text(scene_scan *scan, file_format format, size_t length)
{
    if (strlen(scan->at) == length) return CIPC_OK;
    if (format == FORMAT_GMSH || format == FORMAT_VTK) {
        return scene_scan_reject_at(scan, 0, CIPC_E_BAD_MESH, "binary %s is not read: save as ASCII", format == FORMAT_GMSH ? "Gmsh" : "VTK");
    }
    return scene_scan_reject_at(scan, 0, CIPC_E_BAD_MESH, "not a text file: it has a zero byte");
}

static cipc_status read_parts(scene_scan *scan, scene_parts *parts, file_format format)
{
    if (format == FORMAT_GMSH) return scene_read_gmsh(scan, parts);
    if (format == FORMAT_VTK) return scene_read_vtk(scan, parts);
    return scene_read_obj(scan, parts, format == FORMAT_SEG);
}

static cipc_status read_text(cipc_mesh *mesh, const char *path, file_format format, const char *text, size_t length, cipc_mesh_kind kind, bool keep_all,
                             cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_error own;
    scene_scan scan = {.path = path, .at = text, .line = 1, .error = error != NULL ? error : &own};
    scene_parts parts = scene_parts_of(kind);
    cipc_status status = check_text(&scan, format, length);
    if (status == CIPC_OK) status = read_parts(&scan, &parts, format);
    if (status == CIPC_OK) status = scene_parts_finish(&parts, &scan, keep_all, mesh);
    scene_parts_free(&parts);
    return status;
}

static cipc_status check_name(const char *path, cipc_error *error)
{
    if (format_of(path) != FORMAT_COUNT) return CIPC_OK;
    cipc_fail(error, CIPC_E_BAD_MESH, path, "not the name of a mesh file");
    if (error != NULL) cipc_fail_remedy(error, "save it as .obj, .seg, .msh (Gmsh, ASCII) or .vtk (legacy, ASCII)");
    return CIPC_E_BAD_MESH;
}

cipc_status scene_read_mesh_text(cipc_mesh *mesh, const char *path, const char *text, size_t length, cipc_mesh_kind kind, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check_name(path, error);
    return status == CIPC_OK ? read_text(mesh, path, format_of(path), text, length, kind, false, error) : status;
}

cipc_status cipc_mesh_read(cipc_mesh *mesh, const char *path, cipc_mesh_kind kind, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    char *text = NULL;
    size_t length = 0;
    cipc_status status = check_name(path, error);
    if (status == CIPC_OK) status = scene_read_text(path, &text, &length, error);
    if (status == CIPC_OK) status = scene_read_mesh_text(mesh, path, text, length, kind, error);
    cipc_free(text);
    return status;
}

cipc_status cipc_mesh_read_obj(cipc_mesh *mesh, const char *path, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    char *text = NULL;
    size_t length = 0;
    cipc_status status = scene_read_text(path, &text, &length, error);
    if (status == CIPC_OK) status = read_text(mesh, path, FORMAT_OBJ, text, length, CIPC_MESH_TRIANGLES, true, error);
    cipc_free(text);
    return status;
}
