/* Words of rulers: beside their line, where they hide nothing. */
#include <math.h>

#include "render/plot/graph_private.h"

/* Places tried along a ruler. */
enum { ALONG = 24 };

static double place_of(const struct graph_cell *cell, const struct bead_ruler *ruler)
{
    return bead_axis_place(&cell->axis[ruler->vertical ? 0 : 1], ruler->value);
}

/* A box beside the ruler: `side` 0 or 1, a part of the way along it (of a vertical one from the top, of a level one from the
 * right). */
static struct graph_box beside(const struct graph_cell *cell, const struct bead_look *look, const struct bead_ruler *ruler,
                               double width, double height, int side, double way)
{
    const struct bead_rect *plot = &cell->plot;
    double gap = graph_air(look) + 0.6 * look->line, inset = 0.6 * graph_air(look), place = place_of(cell, ruler);
    if (ruler->vertical) {
        double x = plot->x + place * plot->width;
        return (struct graph_box){side ? x - gap - width : x + gap, plot->y + inset + way * (plot->height - height - 2 * inset),
                                  width, height};
    }
    double y = plot->y + (1 - place) * plot->height, x = plot->x + plot->width - inset - width;
    return (struct graph_box){x - way * (plot->width - width - 2 * inset), side ? y + gap : y - gap - height, width, height};
}

/* Letters sit in boxes with room above and below: only half of the air is kept there. */
static struct graph_box with_air(struct graph_box box, double air)
{
    return (struct graph_box){box.x - 0.8 * air, box.y - 0.3 * air, box.width + 1.6 * air, box.height + 0.6 * air};
}

static bool try_word(struct graph_word *word, const struct graph_cell *cell, const struct bead_look *look,
                     const struct bead_ruler *ruler, double width, double height, const struct graph_mask *mask)
{
    for (int i = 0; i < 2 * ALONG; i++) {
        struct graph_box box = beside(cell, look, ruler, width, height, i % 2, (i / 2) / (ALONG - 1.0));
        if (graph_mask_covered(mask, with_air(box, graph_air(look))) > 0)
            continue;
        word->box = box;
        return true;
    }
    return false;
}

/* Along vertical rulers words are turned where they do not fit level. */
static bool place_word(struct graph_word *word, const struct graph_cell *cell, const struct bead_look *look,
                       const struct bead_ruler *ruler, const struct graph_mask *mask)
{
    double width, height;
    struct bead_text_style style = graph_text(look);
    bead_text_size(NULL, &style, word->markup, &width, &height);
    word->upwards = false;
    if (try_word(word, cell, look, ruler, width, height, mask))
        return true;
    word->upwards = ruler->vertical;
    return ruler->vertical && try_word(word, cell, look, ruler, height, width, mask);
}

bool graph_words_place(struct graph_cell *cell, const struct bead_look *look, struct graph_mask *mask)
{
    bool moved = false;
    for (size_t r = 0; r < cell->panel->ruler_count; r++) {
        struct graph_word *word = &cell->words[r];
        double place = place_of(cell, &cell->panel->rulers[r]);
        if (!word->markup || !(place >= 0 && place <= 1)) {
            word->state = GRAPH_WORD_NONE;
            continue;
        }
        if (word->state == GRAPH_WORD_IN_LEGEND)
            continue;
        bool placed = place_word(word, cell, look, &cell->panel->rulers[r], mask);
        word->state = placed ? GRAPH_WORD_PLACED : GRAPH_WORD_IN_LEGEND;
        moved = moved || !placed;
        if (placed)
            graph_mask_cover(mask, with_air(word->box, graph_air(look)));
    }
    return moved;
}
