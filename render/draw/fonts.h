/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fonts that come with the program. */
#pragma once

/* Where the assets have fonts/fonts.conf, fontconfig reads that instead of the system's configuration, unless FONTCONFIG_FILE names
 * another. To be called before Pango first looks for a font; only the first call does anything. */
void bead_fonts_use_own(void);
