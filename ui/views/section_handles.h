// Handles on the drawn section for sizes of the valve: the user drags them, moves them with arrow
// keys, or types a value. A press without a drag selects the parameter.
//
// Positions are in logical pixels of the picture's widget. The widget calls the functions for its
// events below; those that return gboolean return whether the event was used.
#pragma once

#include "app/draw/geometry.h"
#include "app/section/section.h"
#include "app/session/session.h"

#include <gtk/gtk.h>

typedef struct SbSectionHandles SbSectionHandles;

// Called when a handle selects parameter `id`. `typed` is the text with which the user began to
// type a value; NULL: none.
typedef void (*SbSectionChosen)(void *data, SbParamId id, const char *typed);

// Adds a layer that draws the handles, without events of its own, to the overlay of the picture.
// The result belongs to the layer's widget and is freed with it. `session` is borrowed and must
// outlive it.
SbSectionHandles *sb_section_handles_new(SbSession *session, GtkOverlay *overlay);

// Sets the function that is called when a handle is selected; NULL: none.
void sb_section_handles_listen(SbSectionHandles *handles, SbSectionChosen chosen, void *data);

// Sets the handles for the section that was drawn, at the instant `frame` of a run of `model`;
// `corner` is the position of the picture's top left corner. To be called after each drawing.
// `section` NULL: there are no handles; `model` and `frame` may then be NULL, too. Everything is
// read only during the call.
void sb_section_handles_follow(SbSectionHandles *handles, const SbSection *section,
                               const SbModel *model, const SbFrame *frame, SbPoint corner);

// To be called when the primary button is pressed at (x, y) of the picture [px]. Returns whether it
// took a handle.
gboolean sb_section_handles_press(SbSectionHandles *handles, double x, double y);

// The pointer moved to (x, y); `state` are the modifiers (GdkModifierType). Edits the value while a
// handle is dragged.
gboolean sb_section_handles_motion(SbSectionHandles *handles, double x, double y, guint state);

// The pointer was released.
gboolean sb_section_handles_release(SbSectionHandles *handles);

// The pointer entered the picture.
void sb_section_handles_enter(SbSectionHandles *handles);

// The pointer left the picture.
void sb_section_handles_leave(SbSectionHandles *handles);

// A key was pressed. Arrows change the selected size by 0.01 mm (with Shift by 0.001 mm), Escape
// reverts a drag or ends the selection, and a digit starts to type a value.
gboolean sb_section_handles_key(SbSectionHandles *handles, const GdkEventKey *event);
