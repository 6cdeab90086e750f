/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnings of the libraries that draw become errors of the picture being drawn. */
#include "render/draw/raster.h"

#include <glib.h>
#include <pthread.h>
#include <stdio.h>

/* Per thread: the handler has no other way to reach the thread that draws. */
static _Thread_local char first[200];
static GLogFunc others;

static void keep(const gchar *domain, GLogLevelFlags level, const gchar *text, gpointer data)
{
    /* After a fatal one GLib aborts. */
    if (level & G_LOG_FLAG_FATAL || !(level & (G_LOG_LEVEL_ERROR | G_LOG_LEVEL_CRITICAL | G_LOG_LEVEL_WARNING)))
        others(domain, level, text, data);
    else if (!*first)
        snprintf(first, sizeof first, "%s%s%s", domain ? domain : "", domain ? ": " : "", text);
}

static void replace_handler(void)
{
    others = g_log_set_default_handler(keep, NULL);
}

void bead_warnings_watch(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    (void)pthread_once(&once, replace_handler);
    first[0] = '\0';
}

enum bead_error bead_warnings_check(struct bead_message *msg)
{
    return *first ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "a picture was not drawn correctly: %s", first) : BEAD_OK;
}
