// The valve in three dimensions with a quarter cut away: housing, stem and both rings turned about
// the axis, and on the two cut faces what the section shows, field colours included.
#pragma once

#include "app/section/revolve.h"
#include "app/section/section.h"

typedef struct SbCutaway SbCutaway;

// For the frames of one model, whose inner contact begins there (see sb_valve_make()). Owned by the
// caller; one picture after the other.
SbCutaway *sb_cutaway_create(const SbModel *model, double inner_contact_left);

// NULL is allowed.
void sb_cutaway_destroy(SbCutaway *cutaway);

// Draws the section's instant as its view asks; rings must have their shapes. In sb_section_draw().
void sb_cutaway_draw(SbCutaway *cutaway, SbSection *section);

// The cutaway of a section's last picture; NULL before there was one.
const SbCutaway *sb_section_cutaway(const SbSection *section);
