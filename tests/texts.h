/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The texts of a drawing: a look's watch {texts_note, &texts} keeps each text as markup, with its box in px. What is too small to
 * be read is no text: even an "x" in type of 11 px has 5. */
#ifndef BEADREEL_TESTS_TEXTS_H
#define BEADREEL_TESTS_TEXTS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

struct texts {
    size_t count;
    struct text {
        char markup[400];
        double x, y, width, height;
    } text[512];
};

static void texts_note(void *context, const char *markup, double x, double y, double width, double height)
{
    struct texts *texts = context;
    if (strpbrk(markup, "abcdefghijklmnopqrstuvwxyz0123456789") && !(width > 0 && height > 3))
        fail_msg("'%s' is %g px high", markup, height);
    assert_true(texts->count < sizeof texts->text / sizeof *texts->text);
    struct text *text = &texts->text[texts->count++];
    *text = (struct text){"", x, y, width, height};
    snprintf(text->markup, sizeof text->markup, "%s", markup);
}

#endif
