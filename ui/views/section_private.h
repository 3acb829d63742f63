// Shared by the files of the section's widget: section_view.c (drawing), section_pointer.c (zoom,
// pan and camera) and section_toolbar.c.
#pragma once

#include "app/section/draw_cairo.h"
#include "app/section/gl_renderer.h"
#include "app/section/section.h"
#include "app/session/section_source.h"
#include "ui/views/draw_cache.h"
#include "ui/views/later.h"
#include "ui/views/section_handles.h"
#include "ui/views/section_view.h"

// The widget. Freed with `box`, of which the other widgets are children.
typedef struct {
  SbSession *session; // borrowed
  GtkWidget *gl;      // over the picture, where the window's own GL draws it
  GtkWidget *box, *area, *field_combo, *inset_combo, *forces, *labels, *mesh, *empty, *toggles,
      *heading; // `area` has the picture, `empty` is shown before the first run
  GtkWidget *cutaway, *rest, *no_field, *bar, *zooms;
  int zooms_width;         // width of the zoom buttons and their gap [px]
  SbLater fit;             // fits the toolbar to a new width
  SbSectionSource *source; // section, run and frame that are displayed, owned
  SbDrawList list;         // the picture
  SbText *text;            // measures and draws the texts of `list`, owned
  SbSectionLook look;      // that of the scene when the toolbar last followed it
  double zoom;             // enlargement of the valve, 1 to 6
  double pan_x, pan_y;     // position of the area in the enlarged picture [px]
  double press_x, press_y; // where the pointer was pressed [px]; in the section plus the pan
  gboolean pans;           // a pressed pointer moves or turns the picture
  double press_azimuth, press_elevation; // camera when the pointer was pressed [rad]
  SbGlContext *context;      // GL without a window, owned; NULL: not needed, or there is none
  SbGlRenderer *renderer;    // in `context`, owned; NULL as `context`
  cairo_surface_t *read;     // picture that GL drew, owned
  SbDrawCache *cache;        // picture of `area`
  SbSectionHandles *handles; // handles of dimensions over the picture
  SbLater describe;          // delayed update of the description
} SbSectionWidget;

// Returns whether the cutaway is chosen in the toolbar.
gboolean sb_section_is_cutaway(SbSectionWidget *view);

// Returns whether the displayed run has rings with fields, but not the chosen field.
gboolean sb_section_lacks_field(SbSectionWidget *view);

// Returns whether the present values request the chosen field, so that the next run has it.
gboolean sb_section_asks_field(SbSectionWidget *view);

// Draws the picture again, soon; while something moves not more often than every 33 ms.
void sb_section_redraw(SbSectionWidget *view);

// Draws the picture again and updates its description for assistive technology, both soon.
void sb_section_on_change(SbSectionWidget *view);

// Returns the toolbar in its scroller (floating reference) and sets the widgets of `view` that it
// contains.
GtkWidget *sb_section_toolbar_new(SbSectionWidget *view);

// Limits the pan so that the enlarged picture covers the area.
void sb_section_clamp_pan(SbSectionWidget *view);

// Connects the pointer's events of view->area and view->gl, which must exist.
void sb_section_take_pointers(SbSectionWidget *view);
