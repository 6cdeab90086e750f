/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Appends an update to a PDF file, whose objects cairo writes in clear: "3 0 obj\n<< ... >>\nendobj". */
#include "render/draw/pdf.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* A piece of the file; text NULL: it is not there. */
struct piece {
    const char *text;
    int length;
};

/* What lies between `begin` and `end`, at the last `begin` of the file. */
static struct piece between(const char *pdf, size_t length, const char *begin, const char *end)
{
    const char *found = NULL, *limit = pdf + length;
    for (const char *at = pdf; (at = memmem(at, (size_t)(limit - at), begin, strlen(begin))) != NULL; at++)
        found = at + strlen(begin);
    const char *stop = found ? memmem(found, (size_t)(limit - found), end, strlen(end)) : NULL;
    return stop ? (struct piece){found, (int)(stop - found)} : (struct piece){NULL, 0};
}

/* The number of the object that begins right before a place. */
static long number_before(const char *pdf, const char *place)
{
    while (place > pdf && place[-1] != '\n')
        place--;
    while (place > pdf + 1 && place[-2] != '\n')
        place--;
    return strtol(place > pdf ? place - 1 : place, NULL, 10);
}

void bead_pdf_write(const char *pdf, size_t length, FILE *file)
{
    static const char figure_begins[] = "<< /Type /StructElem\n   /S /Figure\n", catalog_begins[] = "<< /Type /Catalog\n",
                      object_ends[] = ">>\nendobj";
    const struct piece figure = between(pdf, length, figure_begins, object_ends),
                       catalog = between(pdf, length, catalog_begins, object_ends),
                       subject = between(pdf, length, "/Subject ", "\n"), trailer = between(pdf, length, "trailer\n<<", ">>"),
                       before = between(pdf, length, "startxref\n", "\n");
    fwrite(pdf, 1, length, file);
    if (!figure.text || !catalog.text || !subject.text || !trailer.text || !before.text)
        return;
    const long numbers[2] = {number_before(pdf, figure.text - sizeof figure_begins + 1),
                             number_before(pdf, catalog.text - sizeof catalog_begins + 1)};
    size_t at[3] = {length};
    at[1] = at[0] + (size_t)fprintf(file, "%ld 0 obj\n%s%.*s   /Alt %.*s\n%s\n", numbers[0], figure_begins, figure.length,
                                    figure.text, subject.length, subject.text, object_ends);
    at[2] = at[1] + (size_t)fprintf(file,
                                    "%ld 0 obj\n%s%.*s   /Lang (en)\n   /MarkInfo << /Marked true >>\n"
                                    "   /ViewerPreferences << /DisplayDocTitle true >>\n%s\n",
                                    numbers[1], catalog_begins, catalog.length, catalog.text, object_ends);
    fprintf(file, "xref\n%ld 1\n%010zu 00000 n \n%ld 1\n%010zu 00000 n \n", numbers[0], at[0], numbers[1], at[1]);
    fprintf(file, "trailer\n<<%.*s   /Prev %.*s\n>>\nstartxref\n%zu\n%%%%EOF\n", trailer.length, trailer.text, before.length,
            before.text, at[2]);
}
