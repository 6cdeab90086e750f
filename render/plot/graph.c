/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Entry to graphs: draws one into a picture, or writes it to a file. */
#include "render/draw/markup.h"
#include "render/draw/page.h"
#include "render/plot/graph_private.h"

enum bead_error bead_graph_draw(const struct bead_graph *graph, const struct bead_look *look, cairo_t *cr, double width,
                                double height, struct bead_message *msg)
{
    struct graph_layout layout;
    BEAD_TRY(graph_layout_make(graph, look, width, height, NULL, &layout, msg));
    cairo_save(cr);
    graph_draw_all(cr, &layout);
    cairo_restore(cr);
    graph_layout_free(&layout);
    cairo_status_t status = cairo_status(cr);
    return status ? bead_fail(msg, BEAD_ERROR_MEMORY, "graph: %s", cairo_status_to_string(status)) : BEAD_OK;
}

struct job {
    const struct bead_graph *graph;
    const struct bead_output *output;
    struct bead_page page;
    struct bead_look look;
};

static enum bead_error graph_draw(void *context, cairo_t *cr, struct bead_message *msg)
{
    const struct job *job = context;
    struct bead_message why = {""};
    enum bead_error err = bead_graph_draw(job->graph, &job->look, cr, job->page.width, job->page.height, &why);
    if (err == BEAD_ERROR_SCENE)
        return bead_output_wrong(job->output, msg, "%.600s", why.text);
    return err ? bead_fail(msg, err, "%s", why.text) : BEAD_OK;
}

enum bead_error bead_graph_write(const struct bead_graph *graph, const struct bead_output *output, const struct bead_scene *scene,
                                 const char *path, uint64_t *bytes, struct bead_message *msg)
{
    char title[2048] = "", size[BEAD_SIZE_WORDS];
    struct bead_graph whole = *graph;
    whole.title = title;
    whole.caption = output->still.caption;
    struct job job = {.graph = &whole, .output = output};
    BEAD_TRY(bead_page_find(output, &job.page, msg));
    if (bead_page_titled(&job.page))
        bead_markup_quote(scene->title, title, sizeof title);
    whole.size = bead_page_size(&job.page, size);
    bead_page_look(&job.page, &output->paper, &job.look);
    return bead_page_write(&job.page, output, scene, &(struct bead_drawing){graph_draw, NULL, &job}, path, bytes, msg);
}
