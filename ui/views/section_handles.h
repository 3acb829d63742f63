// Sizes of the valve under the hand: handles on the drawn section that are dragged, moved by arrow
// keys or typed over. A press without a drag names the parameter to whoever listens.
#pragma once

#include "app/base/geometry.h"
#include "app/section/section.h"
#include "app/session/session.h"

#include <gtk/gtk.h>

typedef struct SbSectionHandles SbSectionHandles;

// `chosen` is told which parameter a press means; `typed` is the text that was begun, NULL: none.
typedef void (*SbSectionChosen)(void *data, SbParamId id, const char *typed);

// A layer for the picture's overlay, without events of its own; owned by the widget.
SbSectionHandles *sb_section_handles_new(SbSession *session, GtkOverlay *overlay);
void sb_section_handles_listen(SbSectionHandles *handles, SbSectionChosen chosen, void *data);

// After each drawing: the section that was drawn, its instant, and the pixel of the picture's
// corner. NULL: there is none to take hold of.
void sb_section_handles_follow(SbSectionHandles *handles, const SbSection *section,
                               const SbModel *model, const SbFrame *frame, SbPoint corner);

// The pointer, in the picture's widget. Each tells whether it took the event.
gboolean sb_section_handles_press(SbSectionHandles *handles, double x, double y);
gboolean sb_section_handles_motion(SbSectionHandles *handles, double x, double y, guint state);
gboolean sb_section_handles_release(SbSectionHandles *handles);
void sb_section_handles_enter(SbSectionHandles *handles);
void sb_section_handles_leave(SbSectionHandles *handles);

// Arrows move the chosen size by 0.01 mm (Shift: 0.001 mm), Escape takes a drag back or lets go, a
// digit begins to type.
gboolean sb_section_handles_key(SbSectionHandles *handles, const GdkEventKey *event);
