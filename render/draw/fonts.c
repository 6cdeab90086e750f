/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds fonts: the system's, and those that come with the program if it brings its own libraries. */

#include <fcntl.h>
#include <fontconfig/fontconfig.h>
#include <limits.h>
#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#include "render/draw/looks.h"
#include "sim/base/assets.h"

static void use_own(void)
{
    char path[PATH_MAX];
    if (getenv("FONTCONFIG_FILE") || bead_asset_path("fonts/fonts.conf", path, sizeof path, NULL))
        return;
    FcConfig *config = FcConfigCreate();
    if (config && FcConfigParseAndLoad(config, (const FcChar8 *)path, FcFalse) && FcConfigBuildFonts(config))
        FcConfigSetCurrent(config);
    if (config)
        FcConfigDestroy(config);
}

void bead_fonts_use_own(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, use_own);
}

/* Can fonts and their configuration be opened? Fontconfig silently leaves out files that cannot. */
static bool descriptors_are_left(void)
{
    enum { NEEDED = 8 };
    int opened[NEEDED], count = 0;
    while (count < NEEDED && (opened[count] = open("/dev/null", O_RDONLY | O_CLOEXEC)) >= 0)
        count++;
    for (int i = 0; i < count; i++)
        close(opened[i]);
    return count == NEEDED;
}

enum bead_error bead_text_check(struct bead_message *msg)
{
    const char *missing = NULL;
    if (!descriptors_are_left())
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "too few file descriptors are left for fonts (see ulimit -n)");
    bead_fonts_use_own();
    FcStrList *files = FcInit() ? FcConfigGetConfigFiles(NULL) : NULL;
    FcFontSet *fonts = files ? FcConfigGetFonts(NULL, FcSetSystem) : NULL;
    if (!files || !FcStrListNext(files))
        missing = "fontconfig cannot read its configuration";
    else if (!fonts || fonts->nfont == 0)
        missing = "fontconfig finds no font; install some (on Debian, fonts-stix and fonts-lato)";
    if (files)
        FcStrListDone(files);
    return missing ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "text cannot be drawn: %s", missing) : BEAD_OK;
}
