// Pieces joined to outlines, and outlines made half-sections about the line y = 0.
#include "app/cad/cad_private.h"
#include "engine/numeric/arc.h"

#include <math.h>

// Comparing each end with each: a layer of more pieces is no seal's part.
enum { PIECES_MAX = 5000 };

static SbCadPiece reversed(SbCadPiece piece) {
  return (SbCadPiece){piece.x1, piece.y1, piece.x0, piece.y0, -piece.bulge};
}

// The unused piece with the end that is nearest to (x, y), turned to begin there; -1 if none lies
// within `gap`.
static int next_piece(SbCadPiece *out, const GArray *pieces, const bool *used, double x, double y,
                      double gap) {
  int best = -1;
  double nearest = gap;
  for (guint i = 0; i < pieces->len; i++) {
    if (used[i]) {
      continue;
    }
    const SbCadPiece *piece = &g_array_index(pieces, SbCadPiece, i);
    const double first = hypot(piece->x0 - x, piece->y0 - y);
    const double last = hypot(piece->x1 - x, piece->y1 - y);
    if (fmin(first, last) <= nearest) {
      nearest = fmin(first, last);
      best = (int)i;
      *out = first <= last ? *piece : reversed(*piece);
    }
  }
  return best;
}

// Adds pieces to the end of `chain` until it closes or none follows; whether it closes.
static bool extend(GArray *chain, const GArray *pieces, bool *used, double gap) {
  const SbCadPiece first = g_array_index(chain, SbCadPiece, 0);
  for (;;) {
    const SbCadPiece last = g_array_index(chain, SbCadPiece, chain->len - 1);
    if (hypot(last.x1 - first.x0, last.y1 - first.y0) <= gap) {
      return true;
    }
    SbCadPiece next;
    const int found = next_piece(&next, pieces, used, last.x1, last.y1, gap);
    if (found < 0) {
      return false;
    }
    used[found] = true;
    g_array_append_val(chain, next);
  }
}

static void turn(GArray *chain) {
  for (guint i = 0; i < (chain->len + 1) / 2; i++) {
    SbCadPiece *a = &g_array_index(chain, SbCadPiece, i);
    SbCadPiece *b = &g_array_index(chain, SbCadPiece, chain->len - 1 - i);
    const SbCadPiece first = reversed(*b), last = reversed(*a);
    *a = first;
    *b = last;
  }
}

static SbArc circle_of(const SbCadPiece *piece) {
  const double from[2] = {piece->x0, piece->y0}, to[2] = {piece->x1, piece->y1};
  return sb_arc_of(from, to, piece->bulge);
}

// Appends the parts of `piece` above the axis; ends on it have y = 0 exactly.
static void clip(GArray *out, SbCadPiece piece, double gap) {
  piece.y0 = fabs(piece.y0) <= gap ? 0 : piece.y0;
  piece.y1 = fabs(piece.y1) <= gap ? 0 : piece.y1;
  double at[4] = {0, 1, 1, 1}; // where the piece is cut, as parts of its length
  int cuts = 1;
  SbArc arc = {0};
  if (piece.bulge == 0) {
    if (piece.y0 * piece.y1 < 0) {
      at[cuts++] = piece.y0 / (piece.y0 - piece.y1);
    }
  } else {
    arc = circle_of(&piece);
    const double height = arc.centre[1];
    const double half = arc.radius > fabs(height) ? acos(-height / arc.radius) : NAN;
    // Angles of the axis on the circle: sin = -centre / radius.
    for (int side = -1; side <= 1 && !isnan(half); side += 2) {
      const double phi = M_PI / 2 + side * half;
      const double once = 2 * M_PI / fabs(arc.sweep);
      double part = fmod((phi - arc.start) / arc.sweep, once);
      part += part < 0 ? once : 0;
      if (part > 1e-9 && part < 1 - 1e-9) {
        at[cuts++] = part;
      }
    }
    if (cuts == 3 && at[1] > at[2]) {
      const double swap = at[1];
      at[1] = at[2];
      at[2] = swap;
    }
  }
  at[cuts] = 1;
  double x = piece.x0, y = piece.y0;
  for (int i = 1; i <= cuts; i++) {
    const double part = at[i], middle = (at[i - 1] + part) / 2;
    double x1 = piece.x1, y1 = piece.y1, high;
    if (piece.bulge == 0) {
      high = piece.y0 + middle * (piece.y1 - piece.y0);
      x1 = i < cuts ? piece.x0 + part * (piece.x1 - piece.x0) : x1;
    } else {
      double place[2];
      sb_arc_place(&arc, middle, place);
      high = place[1];
      sb_arc_place(&arc, part, place);
      x1 = i < cuts ? place[0] : x1;
    }
    y1 = i < cuts ? 0 : y1;
    if (high > gap) {
      const SbCadPiece kept = {x, y, x1, y1, tan(arc.sweep * (part - at[i - 1]) / 4)};
      g_array_append_val(out, kept);
    }
    x = x1;
    y = y1;
  }
}

static bool on_axis(const SbCadPiece *piece, double gap) {
  return piece->bulge == 0 && fabs(piece->y0) <= gap && fabs(piece->y1) <= gap;
}

// Joins the piece `next` to `last` where both are of one line or one circle.
static bool joined(SbCadPiece *last, const SbCadPiece *next) {
  const double same = 1e-9; // m
  const double one = hypot(last->x1 - last->x0, last->y1 - last->y0);
  const double other = hypot(next->x1 - next->x0, next->y1 - next->y0);
  SbCadPiece both = {last->x0, last->y0, next->x1, next->y1, 0};
  if (last->bulge == 0 && next->bulge == 0) {
    const double cross = (last->x1 - last->x0) * (next->y1 - next->y0) -
                         (last->y1 - last->y0) * (next->x1 - next->x0);
    const double along = (last->x1 - last->x0) * (next->x1 - next->x0) +
                         (last->y1 - last->y0) * (next->y1 - next->y0);
    if (along <= 0 || fabs(cross) > same * fmax(one, other)) {
      return false;
    }
  } else if (last->bulge * next->bulge > 0) {
    const SbArc a = circle_of(last), b = circle_of(next);
    // Through the three ends, which are better known than either piece's curvature.
    both = sb_cad_arc((const double[2]){last->x0, last->y0}, (const double[2]){next->x0, next->y0},
                      (const double[2]){next->x1, next->y1});
    if (hypot(a.centre[0] - b.centre[0], a.centre[1] - b.centre[1]) > same ||
        fabs(a.radius - b.radius) > same || !(fabs(both.bulge) < 1) ||
        both.bulge * last->bulge < 0) {
      return false;
    }
  } else {
    return false;
  }
  *last = both;
  return true;
}

// Fills the body's profile from a chain, which it simplifies; `why` where that is none.
static void to_profile(SbCadBody *body, GArray *chain, bool closed) {
  guint kept = 0;
  for (guint i = 1; i < chain->len; i++) {
    const SbCadPiece next = g_array_index(chain, SbCadPiece, i);
    if (!joined(&g_array_index(chain, SbCadPiece, kept), &next)) {
      g_array_index(chain, SbCadPiece, ++kept) = next;
    }
  }
  g_array_set_size(chain, kept + 1);
  if (chain->len + 1 > SB_PROFILE_MAX) {
    body->why = g_strdup_printf("its half-section has %u pieces, more than %d", chain->len,
                                SB_PROFILE_MAX - 1);
    return;
  }
  for (guint i = 0; i < chain->len; i++) {
    const SbCadPiece *piece = &g_array_index(chain, SbCadPiece, i);
    const SbProfilePoint point = {piece->x0, fmax(piece->y0, 0), piece->bulge};
    g_array_append_val(body->profile, point);
  }
  if (!closed) {
    const SbCadPiece *last = &g_array_index(chain, SbCadPiece, chain->len - 1);
    const SbProfilePoint point = {last->x1, 0, 0};
    g_array_append_val(body->profile, point);
  }
  body->closed = closed;
}

// A closed outline, or one that begins and ends on the axis, as a half-section.
static void half_section(SbCadBody *body, const GArray *chain, bool closed, double gap) {
  g_autoptr(GArray) above = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  for (guint i = 0; i < chain->len; i++) {
    clip(above, g_array_index(chain, SbCadPiece, i), gap);
  }
  // Begin behind what lies on the axis or below it.
  guint breaks = 0, begin = 0;
  for (guint i = 0; i < above->len; i++) {
    const SbCadPiece *one = &g_array_index(above, SbCadPiece, i);
    const SbCadPiece *before = &g_array_index(above, SbCadPiece, (i + above->len - 1) % above->len);
    if (hypot(one->x0 - before->x1, one->y0 - before->y1) > gap) {
      breaks++;
      begin = i;
    }
  }
  if (breaks > 1 || above->len == 0) {
    body->why = g_strdup(above->len == 0 ? "it has no area next to the axis"
                                         : "it crosses the axis more than twice");
    return;
  }
  if (breaks == 1 && begin > 0) {
    g_autoptr(GArray) turned = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
    g_array_append_vals(turned, &g_array_index(above, SbCadPiece, begin), above->len - begin);
    g_array_append_vals(turned, above->data, begin);
    to_profile(body, turned, false);
  } else {
    to_profile(body, above, breaks == 0 && closed);
  }
}

typedef struct {
  GArray *chain; // of SbCadPiece
  bool closed;
  double low, high; // of y
} Outline;

static void clear_outline(gpointer data) {
  g_array_unref(((Outline *)data)->chain);
}

static void find_extent(Outline *outline) {
  outline->low = INFINITY;
  outline->high = -INFINITY;
  for (guint i = 0; i < outline->chain->len; i++) {
    const SbCadPiece *piece = &g_array_index(outline->chain, SbCadPiece, i);
    double middle = piece->y0;
    if (piece->bulge != 0) {
      // The arc's own middle is enough to tell the side.
      middle = (piece->y0 + piece->y1) / 2 - piece->bulge * (piece->x1 - piece->x0) / 2;
    }
    outline->low = fmin(outline->low, fmin(fmin(piece->y0, piece->y1), middle));
    outline->high = fmax(outline->high, fmax(fmax(piece->y0, piece->y1), middle));
  }
}

void sb_cad_outlines(SbCad *cad, const GArray *pieces, const char *name, double gap) {
  if (pieces->len > PIECES_MAX) {
    g_ptr_array_add(cad->warnings, g_strdup_printf("%s: %u pieces, more than %d: left out", name,
                                                   pieces->len, PIECES_MAX));
    return;
  }
  g_autofree bool *used = g_new0(bool, pieces->len + 1);
  g_autoptr(GArray) outlines = g_array_new(FALSE, FALSE, sizeof(Outline));
  g_array_set_clear_func(outlines, clear_outline);
  for (guint i = 0; i < pieces->len; i++) {
    // Pieces on the axis close what ends there; a centre line is no part of an outline.
    used[i] = on_axis(&g_array_index(pieces, SbCadPiece, i), gap);
  }
  guint open = 0;
  for (guint i = 0; i < pieces->len; i++) {
    if (used[i]) {
      continue;
    }
    used[i] = true;
    Outline outline = {g_array_new(FALSE, FALSE, sizeof(SbCadPiece)), false, 0, 0};
    g_array_append_val(outline.chain, g_array_index(pieces, SbCadPiece, i));
    outline.closed = extend(outline.chain, pieces, used, gap);
    if (!outline.closed) {
      turn(outline.chain);
      outline.closed = extend(outline.chain, pieces, used, gap);
    }
    const SbCadPiece *first = &g_array_index(outline.chain, SbCadPiece, 0);
    const SbCadPiece *last = &g_array_index(outline.chain, SbCadPiece, outline.chain->len - 1);
    if (!outline.closed && (fabs(first->y0) > gap || fabs(last->y1) > gap)) {
      open++;
      g_array_unref(outline.chain);
      continue;
    }
    find_extent(&outline);
    g_array_append_val(outlines, outline);
  }
  if (open > 0) {
    g_ptr_array_add(cad->warnings, g_strdup_printf("%s: %u line%s that close%s to no outline", name,
                                                   open, open > 1 ? "s" : "", open > 1 ? "" : "s"));
  }
  bool above = false;
  for (guint i = 0; i < outlines->len; i++) {
    above = above || g_array_index(outlines, Outline, i).high > gap;
  }
  guint made = 0;
  for (guint i = 0; i < outlines->len; i++) {
    const Outline *outline = &g_array_index(outlines, Outline, i);
    if ((above && outline->high <= gap) || cad->bodies->len >= SB_CAD_BODIES_MAX) {
      continue; // the other half of a whole section
    }
    for (guint k = 0; !above && k < outline->chain->len; k++) {
      SbCadPiece *piece = &g_array_index(outline->chain, SbCadPiece, k);
      *piece = (SbCadPiece){piece->x0, -piece->y0, piece->x1, -piece->y1, -piece->bulge};
    }
    g_autofree char *own = ++made > 1 ? g_strdup_printf("%s %u", name, made) : g_strdup(name);
    SbCadBody *body = sb_cad_body_new(own);
    half_section(body, outline->chain, outline->closed, gap);
    g_ptr_array_add(cad->bodies, body);
  }
}
