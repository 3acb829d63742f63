// Shared by section_insets.c (pressure, both insets) and section_inset_film.c (film).
#pragma once

#include "app/draw/axis.h"
#include "app/section/section_private.h"

// Maximum number of points of a curve in an inset.
enum { SB_SECTION_INSET_CURVE = 2000 };

// An inset while it is drawn.
typedef struct {
  SbSection *section;                 // borrowed
  SbDrawList *list;                   // section->list: what is drawn
  const SbPalette *palette;           // section->palette
  int seal;                           // the seal shown
  bool gasket;                        // the valve has a gasket: the stem is below the seal
  SbColor color;                      // colour of the seal
  const SbColor *body;                // colour of the sliding part: housing, or stem below a gasket
  const SbSealFrame *frame;           // the seal at this instant, borrowed
  const SbContactProfile *profile;    // its profiles, borrowed; NULL: none
  bool contact;                       // the seal is in contact with the bore
  SbRect rect;                        // the inset [px]
  double right, low;                  // right and lower end of `rect` [px]
  SbScale x;                          // from the position in the seal's frame [m] to pixels
  SbScale y;                          // from pressure [Pa] or film thickness [m] to pixels
  double left_contact, right_contact; // ends of the contact [px]
} SbSectionInset;

// Returns an inset of the seal section->view->inset_seal in `rect` [px], in which the value 0 is at
// the height `line` and the value `full` at the height `top` [px].
SbSectionInset sb_section_inset(SbSection *section, const SbRect *rect, double line, double full,
                                double top);

// Writes the curve of value[in->profile->count] to points[SB_SECTION_INSET_CURVE] [px], not below
// the height `low` [px], with points at least 0.6 px apart, and returns their number.
size_t sb_section_inset_curve(const SbSectionInset *in, const double *value, double low,
                              SbPoint *points);

// Fills the rectangle with the corners (x, y) and (right, low) [px].
void sb_section_inset_fill(const SbSectionInset *in, double x, double y, double right, double low,
                           SbColor color);

// Fills the inset below the height `top` with the fluids on the left and on the right of
// x = `split` [px].
void sb_section_inset_fluids(const SbSectionInset *in, double top, double split);

// Draws the frame with the seal's name and the content of the inset, or `brief` if the frame is too
// narrow for `content`. Ends the clip of the list.
void sb_section_inset_frame(const SbSectionInset *in, const char *content, const char *brief);

// Draws the inset of the film in `rect` [px].
void sb_section_draw_film(SbSection *section, const SbRect *rect);
