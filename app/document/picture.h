// The scene inside a picture: a PNG that this program wrote contains the text of the scene that it
// shows, so that it can be opened like a scene.
#pragma once

#include "app/base/error.h"

#include <stddef.h>

// Key of the PNG text chunk that contains the scene.
#define SB_PICTURE_SCENE_KEY "sealbench-scene"

// Largest PNG that is searched, and largest scene that is extracted [bytes].
#define SB_PICTURE_BYTES_MAX ((size_t)256 << 20)
#define SB_PICTURE_SCENE_MAX ((size_t)4000000)

// Returns the text of the scene in the `length` bytes of a PNG that this program wrote. NULL with
// SB_APP_ERROR_INPUT if the bytes are not a PNG, contain no scene, or the scene is damaged.
char *sb_picture_find_scene(const void *data, size_t length, GError **error);
