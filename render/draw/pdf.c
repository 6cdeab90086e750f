/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Appends an update to a PDF file, whose objects cairo writes in clear: "3 0 obj\n<< ... >>\nendobj". */
#include "render/draw/vector.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "render/origin/origin.h"

/* A piece of the file; text NULL: it does not exist. */
struct piece {
    const char *text;
    int length;
};

/* Finds the text between the file's last `begin` and the `end` after it. */
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

/* The scene as an attached file (7.11.4): the numbers of the two objects are `number` and the next. Sets the places of both. */
static size_t attach(const char *source, long number, size_t place, size_t at[2], FILE *file)
{
    static const char mark[] = "# " BEAD_ORIGIN_HEAD;
    at[0] = place;
    at[1] = place + (size_t)fprintf(file, "%ld 0 obj\n<< /Type /EmbeddedFile /Length %zu >>\nstream\n%s%s\nendstream\nendobj\n",
                                    number, sizeof mark - 1 + strlen(source), mark, source);
    return at[1] +
           (size_t)fprintf(file, "%ld 0 obj\n<< /Type /Filespec /F (scene.yaml) /UF (scene.yaml) /EF << /F %ld 0 R >> >>\nendobj\n",
                           number + 1, number);
}

void bead_pdf_write(const char *pdf, size_t length, const char *source, FILE *file)
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
    static const char size_key[] = "/Size ";
    const char *size = memmem(trailer.text, (size_t)trailer.length, size_key, strlen(size_key)), *rest = NULL;
    const long first = size ? strtol(size + strlen(size_key), (char **)&rest, 10) : 0;
    const bool attached = source && *source && first > 0;
    char names[96] = "";
    size_t at[3] = {length}, added[2] = {0};
    if (attached)
        snprintf(names, sizeof names, "   /Names << /EmbeddedFiles << /Names [(scene.yaml) %ld 0 R] >> >>\n", first + 1);
    at[1] = at[0] + (size_t)fprintf(file, "%ld 0 obj\n%s%.*s   /Alt %.*s\n%s\n", numbers[0], figure_begins, figure.length,
                                    figure.text, subject.length, subject.text, object_ends);
    at[2] = at[1] + (size_t)fprintf(file,
                                    "%ld 0 obj\n%s%.*s   /Lang (en)\n   /MarkInfo << /Marked true >>\n"
                                    "   /ViewerPreferences << /DisplayDocTitle true >>\n%s%s\n",
                                    numbers[1], catalog_begins, catalog.length, catalog.text, names, object_ends);
    if (attached)
        at[2] = attach(source, first, at[2], added, file);
    fprintf(file, "xref\n%ld 1\n%010zu 00000 n \n%ld 1\n%010zu 00000 n \n", numbers[0], at[0], numbers[1], at[1]);
    if (attached)
        fprintf(file, "%ld 2\n%010zu 00000 n \n%010zu 00000 n \n", first, added[0], added[1]);
    fprintf(file, "trailer\n<<");
    if (attached)
        fprintf(file, "%.*s%ld%.*s", (int)(size + strlen(size_key) - trailer.text), trailer.text, first + 2,
                (int)(trailer.text + trailer.length - rest), rest);
    else
        fprintf(file, "%.*s", trailer.length, trailer.text);
    fprintf(file, "   /Prev %.*s\n>>\nstartxref\n%zu\n%%%%EOF\n", before.length, before.text, at[2]);
}
