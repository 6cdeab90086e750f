/* SPDX-License-Identifier: GPL-3.0-or-later */
/* beadsim: computes what a scene asks for and writes its data: trajectories and tables. No graphics. */
#include "beadreel/sweep.h"
#include "sim/cli/command_line.h"

static const struct command_list lists[] = {
    {"scenes", command_list_scenes},
    {"materials", command_list_materials},
    {"methods", command_list_methods},
    {"laws", command_list_laws},
    {"equations", command_list_equations},
    {"measures", command_list_measures},
    {"thresholds", command_list_thresholds},
    {"libraries", command_list_libraries},
    {"keys", command_list_keys},
    {"schema", command_list_schema},
    {NULL, NULL},
};

int main(int argc, char **argv)
{
    const struct bead_sink_type *const *const sinks[] = {bead_data_sinks(), NULL};
    const struct command_program program = {
        .name = "beadsim",
        .purpose = "compute waves in chains of elastic beads: data only, no pictures",
        .usage = "Usage:\n"
                 "  beadsim [OPTION]... SCENE.yaml  make the trajectories and tables of a scene\n"
                 "A name without a path is a ready scene (--list scenes).\n",
        .examples = "Examples:\n"
                    "  beadsim clean-vs-delocalised -o results\n"
                    "  beadsim scene.yaml --set simulate.method=rkn8 --set simulate.step='0.1 us' --only peaks.csv\n"
                    "  beadsim --list keys table           keys of one part of a scene\n",
        .lists = lists,
        .sinks = sinks,
    };
    return command_main(&program, argc, argv);
}
