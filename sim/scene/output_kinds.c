/* The table of the kinds of outputs. A new kind is a row here, a table of keys in output_options.c, and a sink that makes it. */
#include "sim/scene/output_kinds.h"

#include <string.h>
#include <strings.h>

#include "sim/scene/scene_output.h"

static const struct bead_output_type types[BEAD_OUTPUT_KINDS] = {
    [BEAD_OUTPUT_TRAJECTORY] = {.options = &bead_trajectory_options,
                                .checks = {bead_output_check_field_list, bead_output_check_times},
                                .stores_samples = true},
    [BEAD_OUTPUT_IMAGE] = {.options = &bead_image_options,
                           .checks = {bead_output_check_field, bead_output_check_still_views, bead_output_check_times,
                                      bead_output_check_moment, bead_output_check_trust, bead_output_check_panels},
                           .draws = true},
    [BEAD_OUTPUT_MOVIE] = {.options = &bead_movie_options,
                           .checks = {bead_output_check_field, bead_output_check_views, bead_output_check_times,
                                      bead_output_check_trust, bead_output_check_movie},
                           .draws = true},
    [BEAD_OUTPUT_PLOT] = {.options = &bead_plot_options,
                          .sweep_options = &bead_sweep_plot_options,
                          .checks = {bead_output_check_times, bead_output_check_drawing, bead_output_check_show,
                                     bead_output_check_trust, bead_output_check_panels},
                          .check_sweep = bead_output_check_sweep_curves,
                          .shows = true,
                          .draws = true},
    [BEAD_OUTPUT_TABLE] = {.options = &bead_table_options,
                           .sweep_options = &bead_sweep_table_options,
                           .checks = {bead_output_check_times, bead_output_check_show},
                           .check_sweep = bead_output_check_sweep_curves,
                           .shows = true},
    [BEAD_OUTPUT_SWEEP] = {.sweep_options = &bead_sweep_file_options, .stores_sweep = true},
    [BEAD_OUTPUT_SHEET] = {.sweep_options = &bead_sheet_options, .check_sweep = bead_output_check_sheet, .draws = true},
};

const struct bead_output_type *bead_output_type(enum bead_output_kind kind)
{
    return &types[kind];
}

static const struct bead_options *main_options(const struct bead_output_type *type)
{
    return type->options ? type->options : type->sweep_options;
}

const char *bead_output_key(enum bead_output_kind kind)
{
    return main_options(&types[kind])->rows[0].key;
}

const char *bead_output_endings(enum bead_output_kind kind)
{
    return strchr(main_options(&types[kind])->rows[0].shape, '.'); /* behind FILE */
}

bool bead_output_ends_like(const char *endings, const char *path)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    for (const char *known = endings; dot && dot > base && known; known = strchr(known + 1, '.')) {
        if (strcspn(known, ", ") == strlen(dot) && strncasecmp(known, dot, strlen(dot)) == 0)
            return true;
    }
    return false;
}

/* The kinds, those that sweeps have otherwise, and panels. */
static const struct bead_options *family_member(size_t index)
{
    static const struct bead_options *const panels[] = {&bead_image_panel_options, &bead_plot_panel_options};
    if (index < BEAD_OUTPUT_KINDS)
        return main_options(&types[index]);
    index -= BEAD_OUTPUT_KINDS;
    for (size_t i = 0; i < BEAD_OUTPUT_KINDS; i++) {
        if (types[i].options && types[i].sweep_options && index-- == 0)
            return types[i].sweep_options;
    }
    return index < 2 ? panels[index] : NULL;
}
const struct bead_option_family bead_output_family = {"outputs", "outputs of kind", family_member};
