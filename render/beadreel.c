/* SPDX-License-Identifier: GPL-3.0-or-later */
/* beadreel: does everything a scene asks for, pictures and movies included; draws existing trajectories. */
#include "beadreel/kinds.h"
#include "beadreel/movie.h"
#include "beadreel/render.h"
#include "beadreel/sweep.h"
#include "render/colour/colour_table.h"
#include "render/encode/libav.h"
#include "render/encode/movie_internal.h"
#include "render/origin/origin.h"
#include "render/paint/canvas.h"
#include "render/paint/gl_context.h"
#include "sim/cli/command_line.h"
#include "sim/kinds/view_kinds.h"

static COMMAND_LISTS(list_colormaps)
{
    for (const struct bead_colormap_info *map = bead_colormap_list(); map->name; map++)
        fprintf(out, "%-14s  %s\n", map->name, map->description);
    return BEAD_OK;
}

static COMMAND_LISTS(list_codecs)
{
    const struct bead_codec_info *codec;
    for (size_t i = 0; (codec = bead_movie_codec(i)); i++)
        fprintf(out, "%-14s  %s\n", codec->extension, codec->description);
    return BEAD_OK;
}

static COMMAND_LISTS(list_views)
{
    for (size_t i = 0; i < BEAD_VIEW_KINDS; i++)
        fprintf(out, "%-14s  %s\n", bead_view_infos[i].name, bead_view_infos[i].help);
    return BEAD_OK;
}

static COMMAND_LISTS(list_libraries)
{
    command_list_opened(out, bead_context_osmesa.libraries);
    command_list_opened(out, bead_context_egl.libraries);
    command_list_opened(out, bead_av_libraries);
    return command_list_libraries(out, msg);
}

static const struct command_list lists[] = {
    {"scenes", command_list_scenes},
    {"materials", command_list_materials},
    {"methods", command_list_methods},
    {"laws", command_list_laws},
    {"equations", command_list_equations},
    {"measures", command_list_measures},
    {"thresholds", command_list_thresholds},
    {"colormaps", list_colormaps},
    {"codecs", list_codecs},
    {"libraries", list_libraries},
    {"keys", command_list_keys},
    {"schema", command_list_schema},
    {"views", list_views},
    {NULL, NULL},
};

int main(int argc, char **argv)
{
    const char *canvases[8] = {NULL};
    for (size_t i = 0; i + 1 < sizeof canvases / sizeof *canvases && bead_canvas_backend_info(i); i++)
        canvases[i] = bead_canvas_backend_info(i)->name;
    const struct bead_sink_type *const *const sinks[] = {bead_data_sinks(), bead_render_sinks(), NULL};
    const struct command_program program = {
        .name = "beadreel",
        .purpose = "compute and film waves in chains of elastic beads",
        .usage = "Usage:\n"
                 "  beadreel [OPTION]... SCENE.yaml          make all outputs of a scene, or of a ready one by its name\n"
                 "  beadreel [OPTION]... FILE.h5 -o out.png  draw a trajectory, several, or the results of a sweep (png, pdf, mp4, "
                 "...)\n",
        .examples = "Example:"
                    " beadreel clean-vs-delocalised -o demo --only waves.mp4 --set outputs.0.size='[640, 360]'\n",
        .lists = lists,
        .sinks = sinks,
        .canvases = canvases,
        .find_origin = bead_origin_read,
    };
    return command_main(&program, argc, argv);
}
