// The scene inside a picture: what a PNG that this program wrote restores when it is opened.
#pragma once

#include "app/base/error.h"

#include <stddef.h>

// Key of the text chunk that holds the scene.
#define SB_PICTURE_SCENE_KEY "sealbench-scene"

// Largest PNG that is looked into, and largest scene that is taken out of one.
#define SB_PICTURE_BYTES_MAX ((size_t)256 << 20)
#define SB_PICTURE_SCENE_MAX ((size_t)4000000)

// The scene's text in a PNG that sb_still_write() made; owned by the caller. NULL with an error if
// there is none.
char *sb_picture_find_scene(const void *data, size_t length, GError **error);
