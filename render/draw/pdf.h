/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PDF files: what cairo lacks, a text in place of the figure for those who do not see it, and the scene. */
#pragma once

#include <stdio.h>

/* Writes a whole file of cairo's, in which a tag Figure holds all of the page, and after it an update (ISO 32000-1, 7.5.6) that
 * gives the figure the document's subject as its text (/Alt, 14.9.3), and the document its language and a window with its title.
 * `source` (NULL or "": none), the scene, is attached as scene.yaml. Files of other shape stay as they are. Write errors show when
 * the file is closed. */
void bead_pdf_write(const char *pdf, size_t length, const char *source, FILE *file);
