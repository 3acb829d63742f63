// The valve in three dimensions with a quarter cut away: housing, stem and both rings turned about
// the axis; the two cut faces show what the section shows, including field colours.
#pragma once

#include "app/section/revolve.h"
#include "app/section/section.h"

typedef struct SbCutaway SbCutaway;

// Returns a cutaway for the frames of `model` (read only during the call), for any number of
// pictures. `inner_contact_left` is the left end of the inner seal's contact in its own frame when
// it reaches the land edge [m]. Freed by sb_cutaway_destroy().
SbCutaway *sb_cutaway_create(const SbModel *model, double inner_contact_left);

// Frees a cutaway.
void sb_cutaway_destroy(SbCutaway *cutaway);

// Adds the cutaway at the section's present instant to the section's display list, with the camera
// of its view. Called by sb_section_draw(), after it has set the shapes of the rings.
void sb_cutaway_draw(SbCutaway *cutaway, SbSection *section);
