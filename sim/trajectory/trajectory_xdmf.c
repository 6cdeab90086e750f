/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the XDMF file beside a trajectory: a grid of points for each sample, whose numbers stay in the HDF5 file. The format is
 * XDMF 2 with slabs of datasets written as items: VTK's reader of XDMF 3 (9.1) cannot read these, nor that of XDMF 2 slabs written
 * as paths. */
#include "sim/trajectory/trajectory_sink.h"

#include <string.h>

#include "sim/chain/system.h"

struct xdmf {
    FILE *out;
    const struct bead_sink *sink;
    const char *data; /* name of the HDF5 file, relative to the XDMF file */
    size_t samples;
};

static void put_escaped(const char *text, FILE *out)
{
    static const struct {
        char character;
        const char *entity;
    } entities[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
    for (; *text; text++) {
        size_t i = 0;
        while (i < sizeof entities / sizeof *entities && entities[i].character != *text)
            i++;
        if (i < sizeof entities / sizeof *entities)
            fputs(entities[i].entity, out);
        else
            fputc(*text, out);
    }
}

static const char *last_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* A whole dataset; `size`: its lengths. */
static void put_dataset(const struct xdmf *x, const char *size, const char *path)
{
    fprintf(x->out, "<DataItem Dimensions=\"%s\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">", size);
    put_escaped(x->data, x->out);
    fprintf(x->out, ":%s</DataItem>", path);
}

/* One sample of a series. */
static void put_sample(const struct xdmf *x, const struct bead_series_info *info, size_t sample)
{
    char size[80], path[80];
    const size_t beads = x->sink->beads;
    snprintf(path, sizeof path, "%s/value", info->group);
    if (info->components > 1) {
        fprintf(x->out, "<DataItem ItemType=\"HyperSlab\" Dimensions=\"%zu 3\"><DataItem Dimensions=\"3 3\" Format=\"XML\">",
                beads);
        fprintf(x->out, "%zu 0 0 1 1 1 1 %zu 3</DataItem>", sample, beads);
        snprintf(size, sizeof size, "%zu %zu 3", x->samples, beads);
    } else {
        fprintf(x->out, "<DataItem ItemType=\"HyperSlab\" Dimensions=\"%zu\"><DataItem Dimensions=\"3 2\" Format=\"XML\">", beads);
        fprintf(x->out, "%zu 0 1 1 1 %zu</DataItem>", sample, beads);
        snprintf(size, sizeof size, "%zu %zu", x->samples, beads);
    }
    put_dataset(x, size, path);
    fputs("</DataItem>", x->out);
}

static void open_attribute(const struct xdmf *x, const char *name, bool vector)
{
    fprintf(x->out, "<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"Node\">", name, vector ? "Vector" : "Scalar");
}

static void put_constants(const struct xdmf *x)
{
    static const char *const names[] = {"mass", "radius"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char size[40], path[80];
        snprintf(size, sizeof size, "%zu", x->sink->beads);
        snprintf(path, sizeof path, "/particles/chain/%s", names[i]);
        open_attribute(x, names[i], false);
        put_dataset(x, size, path);
        fputs("</Attribute>\n", x->out);
    }
}

static void put_grid(const struct xdmf *x, size_t sample)
{
    fprintf(x->out, "<Grid Name=\"beads\" GridType=\"Uniform\"><Time Value=\"%.17g\"/>\n", bead_grid_time(&x->sink->grid, sample));
    fprintf(x->out, "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%zu\" NodesPerElement=\"1\"/>\n", x->sink->beads);
    fputs("<Geometry GeometryType=\"XYZ\">", x->out);
    put_sample(x, &bead_series[BEAD_SERIES_POSITION], sample);
    fputs("</Geometry>\n", x->out);
    for (int id = 0; id < BEAD_SERIES_COUNT; id++) {
        if (id == BEAD_SERIES_POSITION || bead_series[id].of_contacts || !bead_trajectory_wants(x->sink, id))
            continue;
        open_attribute(x, last_name(bead_series[id].group), bead_series[id].components > 1);
        put_sample(x, &bead_series[id], sample);
        fputs("</Attribute>\n", x->out);
    }
    if (bead_chain_spec(x->sink->context.chains[0])->system->has_contacts)
        put_constants(x);
    fputs("</Grid>\n", x->out);
}

static enum bead_error fill(void *context, FILE *file, const char *, struct bead_message *)
{
    const struct bead_sink *sink = context;
    const struct xdmf x = {file, sink, last_name(sink->path), sink->chunk_first + sink->filled};
    fputs("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"2.0\"><Domain>\n",
          file);
    fputs("<Grid Name=\"chain\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", file);
    for (size_t sample = 0; sample < x.samples; sample++)
        put_grid(&x, sample);
    fputs("</Grid>\n</Domain></Xdmf>\n", file);
    return BEAD_OK; /* the caller checks the FILE for errors */
}

enum bead_error bead_trajectory_write_xdmf(struct bead_sink *sink, struct bead_message *msg)
{
    return bead_file_write(sink->xdmf, fill, sink, &sink->xdmf_bytes, msg);
}
