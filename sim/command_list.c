/* Lists that need no graphics: ready scenes, materials, methods, laws. */
#include "sim/command_line.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "beadreel/assets.h"
#include "beadreel/law.h"
#include "beadreel/methods.h"
#include "beadreel/scene.h"

/* Print one ready scene: its name without the extension and its title. */
static enum bead_error list_scene(FILE *out, const char *path, const char *name, struct bead_message *msg)
{
    struct bead_scene *scene;
    enum bead_error err = bead_scene_load(path, NULL, 0, &scene, msg);
    if (err)
        return err;
    fprintf(out, "%-24.*s  %s\n", (int)(strlen(name) - strlen(".yaml")), name, scene->title);
    bead_scene_free(scene);
    return BEAD_OK;
}

static enum bead_error list_directory(FILE *out, const char *directory, const char *prefix, int depth, struct bead_message *msg);

static enum bead_error list_entry(FILE *out, const char *directory, const char *prefix, const char *entry, int depth,
                                  struct bead_message *msg)
{
    char path[PATH_MAX], name[PATH_MAX];
    struct stat status;
    size_t length = strlen(entry);
    if (entry[0] == '.')
        return BEAD_OK;
    if (snprintf(path, sizeof path, "%s/%s", directory, entry) >= (int)sizeof path ||
        snprintf(name, sizeof name, "%s%s", prefix, entry) >= (int)sizeof name - 1)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: the name is too long", entry);
    if (stat(path, &status))
        return bead_fail(msg, BEAD_ERROR_IO, "%s: %s", path, strerror(errno));
    if (S_ISDIR(status.st_mode)) {
        strcat(name, "/");
        return list_directory(out, path, name, depth + 1, msg);
    }
    if (length > strlen(".yaml") && strcmp(entry + length - strlen(".yaml"), ".yaml") == 0)
        return list_scene(out, path, name, msg);
    return BEAD_OK;
}

static enum bead_error list_directory(FILE *out, const char *directory, const char *prefix, int depth, struct bead_message *msg)
{
    struct dirent **entries;
    enum bead_error err = BEAD_OK;
    if (depth > 4)
        return BEAD_OK;
    int count = scandir(directory, &entries, NULL, alphasort);
    if (count < 0)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: %s", directory, strerror(errno));
    for (int i = 0; i < count; i++) {
        if (!err)
            err = list_entry(out, directory, prefix, entries[i]->d_name, depth, msg);
        free(entries[i]);
    }
    free(entries);
    return err;
}

enum bead_error command_list_scenes(FILE *out, struct bead_message *msg)
{
    char directory[PATH_MAX];
    enum bead_error err = bead_asset_path("scenes", directory, sizeof directory, msg);
    return err ? err : list_directory(out, directory, "", 0, msg);
}

enum bead_error command_list_materials(FILE *out, struct bead_message *msg)
{
    /* The smallest scene brings the materials of the assets with it. */
    static const char smallest[] = "chain: {striker: {bead: large-steel, velocity: 1}, beads: [{bead: large-steel}]}\n"
                                   "outputs: [{table: peaks.csv, show: peaks}]\n";
    struct bead_scene *scene;
    enum bead_error err = bead_scene_parse("materials", smallest, sizeof smallest - 1, NULL, 0, &scene, msg);
    if (err)
        return err;
    for (size_t i = 0; i < scene->material_count; i++) {
        const struct bead_material *material = &scene->materials[i];
        char mass[32] = "for walls", radius[32] = "", modulus[32];
        if (isfinite(material->mass))
            command_quantity(1e3 * material->mass, "g", mass, sizeof mass);
        if (isfinite(material->radius))
            command_quantity(material->radius, "m", radius, sizeof radius);
        fprintf(out, "%-14s  %-10s  radius %-8s  modulus %-9s  poisson %g\n", material->name, mass, *radius ? radius : "-",
                command_quantity(material->modulus, "Pa", modulus, sizeof modulus), material->poisson);
    }
    bead_scene_free(scene);
    return BEAD_OK;
}

enum bead_error command_list_methods(FILE *out, struct bead_message *msg)
{
    (void)msg;
    const struct bead_method_info *method;
    for (size_t i = 0; (method = bead_method_info(i)); i++)
        fprintf(out, "%-10s  order %d, %d force evaluation%s a step%s: %s\n", method->name, method->order, method->evaluations,
                method->evaluations == 1 ? "" : "s", method->damping ? ", damping" : "", method->description);
    return BEAD_OK;
}

enum bead_error command_list_laws(FILE *out, struct bead_message *msg)
{
    (void)msg;
    const struct bead_law *law;
    for (size_t i = 0; (law = bead_law_info(i)); i++)
        fprintf(out, "%-16s  %s\n", law->name, law->description);
    return BEAD_OK;
}
