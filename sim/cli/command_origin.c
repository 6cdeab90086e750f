/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the scene in a file that was made from it. */
#include <string.h>

#include "sim/cli/command_line.h"
#include "sim/hdf5/h5.h"
#include "sim/kinds/output_kinds.h"
#include "sim/yaml/yaml.h"

static const char program[] = "beadreel ";

static enum bead_error find_in_h5(const char *path, struct command_origin *origin, struct bead_message *msg)
{
    static const char profile[] = "/parameters/beadreel";
    struct bead_h5 h5;
    char said[64] = "";
    bead_h5_open(&h5, path, "result", msg);
    const bool trajectory = !h5.error && bead_h5_has(&h5, profile);
    if (trajectory) {
        hid_t group = bead_h5_open_group(&h5, profile);
        bead_h5_get_text(&h5, group, "file", origin->file, sizeof origin->file);
        bead_h5_get_text(&h5, group, "program", said, sizeof said);
        bead_h5_close(&h5, &group);
    }
    if (!h5.error)
        origin->scene = bead_h5_read_text(&h5, trajectory ? "/parameters/beadreel/scene" : "/scene", BEAD_YAML_BYTES + 1);
    if (strncmp(said, program, strlen(program)) == 0)
        snprintf(origin->version, sizeof origin->version, "%.31s", said + strlen(program));
    bead_h5_shut(&h5);
    return h5.error;
}

/* Takes an option from the comments above the scene. */
static void take_option(char *scene, const char *name, char *value, size_t size)
{
    char begin[32];
    const int length = snprintf(begin, sizeof begin, "# beadreel --%s ", name);
    const char *end = strncmp(scene, begin, (size_t)length) == 0 ? strchr(scene, '\n') : NULL;
    if (!end)
        return;
    snprintf(value, size, "%.*s", (int)(end - scene) - length, scene + length);
    memmove(scene, end + 1, strlen(end + 1) + 1);
}

enum bead_error command_find_origin(const struct command *command, const char *path, struct command_origin *origin,
                                    struct bead_message *msg)
{
    *origin = (struct command_origin){.scene = NULL};
    if (bead_output_ends_like(".h5", path))
        return find_in_h5(path, origin, msg);
    if (!command->program->find_origin)
        return BEAD_OK;
    BEAD_TRY(command->program->find_origin(path, &origin->scene, origin->version, sizeof origin->version, msg));
    if (origin->scene) {
        take_option(origin->scene, "frame", origin->frame, sizeof origin->frame);
        take_option(origin->scene, "still", origin->still, sizeof origin->still);
    }
    return BEAD_OK;
}
