// Pieces joined to outlines, and outlines made half-sections about the line y = 0.
#include "app/base/number.h"
#include "app/cad/cad_private.h"
#include "app/cad/profile.h"

#include <math.h>
#include <string.h>

// Comparing each end with each: a layer of more pieces is no seal's part.
enum { OUTLINE_PIECES_MAX = 5000, NEAR_MAX = 1000000 };

// Pieces that are shorter are ignored; the largest distance between pieces that are drawn twice; of
// a circle from the next one that continues it, and of a line from points on it; ends that are one
// point where a body is cut [m].
static const double TINY = 1e-9, DOUBLED = 1e-6, CONTINUED = 1e-9, STRAIGHT = 1e-8, CUT_GAP = 1e-8;

static SbCadPiece reversed(SbCadPiece piece) {
  return (SbCadPiece){piece.x1, piece.y1, piece.x0, piece.y0, -piece.bulge};
}

// Length of a piece.
static double length_of(const SbCadPiece *piece) {
  const double chord = hypot(piece->x1 - piece->x0, piece->y1 - piece->y0);
  const double half = 2 * atan(fabs(piece->bulge));
  return half > 0 ? chord * half / sin(half) : chord;
}

// Returns whether a chain ends where it begins and is longer than the gap between ends.
static bool closes(const GArray *chain, double gap) {
  const SbCadPiece *first = &g_array_index(chain, SbCadPiece, 0);
  const SbCadPiece *last = &g_array_index(chain, SbCadPiece, chain->len - 1);
  double length = 0;
  for (guint i = 0; length <= 2 * gap && i < chain->len; i++) {
    length += length_of(&g_array_index(chain, SbCadPiece, i));
  }
  return length > 2 * gap && hypot(last->x1 - first->x0, last->y1 - first->y0) <= gap;
}

// Appends the unused piece with the end that is nearest to the end of `chain`, turned to begin
// there; false if none is within `gap`.
static bool append_next(GArray *chain, const GArray *pieces, bool *used, double gap) {
  const SbCadPiece last = g_array_index(chain, SbCadPiece, chain->len - 1);
  guint best = pieces->len;
  SbCadPiece next = last;
  double nearest = gap * gap;
  for (guint i = 0; i < pieces->len; i++) {
    if (used[i]) {
      continue;
    }
    const SbCadPiece *piece = &g_array_index(pieces, SbCadPiece, i);
    const double dx0 = piece->x0 - last.x1, dy0 = piece->y0 - last.y1;
    const double dx1 = piece->x1 - last.x1, dy1 = piece->y1 - last.y1;
    const double begin = dx0 * dx0 + dy0 * dy0, end = dx1 * dx1 + dy1 * dy1;
    if (fmin(begin, end) <= nearest) {
      nearest = fmin(begin, end);
      best = i;
      next = begin <= end ? *piece : reversed(*piece);
    }
  }
  if (best < pieces->len) {
    used[best] = true;
    g_array_append_val(chain, next);
  }
  return best < pieces->len;
}

static void turn(GArray *chain) {
  g_autoptr(GArray) old = g_array_copy(chain);
  for (guint i = 0; i < old->len; i++) {
    const SbCadPiece piece = g_array_index(old, SbCadPiece, old->len - 1 - i);
    g_array_index(chain, SbCadPiece, i) = reversed(piece);
  }
}

// The point of a piece at a fraction of its length.
static void point_of(const SbCadPiece *piece, double part, double at[2]) {
  at[0] = piece->x0 + part * (piece->x1 - piece->x0);
  at[1] = piece->y0 + part * (piece->y1 - piece->y0);
  if (piece->bulge != 0) {
    const SbArc arc = sb_cad_circle(piece);
    sb_arc_place(&arc, part, at);
  }
}

// Returns the place of a point on the line or circle of a piece as a fraction of its length; not a
// number if the point is farther than `same` from it.
static double place_on(const SbCadPiece *piece, double x, double y, double same) {
  double off;
  const double place = sb_cad_place(piece, x, y, &off);
  return off <= same ? place : NAN;
}

// A piece with the circle about its middle in which it is.
typedef struct {
  SbCadPiece piece;
  double middle[2], reach;
} Drawn;

static Drawn drawn_of(const SbCadPiece piece) {
  Drawn drawn = {.piece = piece, .reach = length_of(&piece) / 2};
  point_of(&piece, 0.5, drawn.middle);
  return drawn;
}

// Writes to `place` where the ends of `other` are on `piece`, if both are of one line or circle.
static bool overlaps(const SbCadPiece *piece, const Drawn *other, double same, double place[2]) {
  const SbCadPiece *ends = &other->piece;
  place[0] = place_on(piece, ends->x0, ends->y0, same);
  if (isnan(place[0]) || other->reach <= 2 * same) {
    return false;
  }
  place[1] = place_on(piece, ends->x1, ends->y1, same);
  return !isnan(place[1]) && !isnan(place_on(piece, other->middle[0], other->middle[1], same));
}

// Divides a piece of `all` (of Drawn) at an end of another that runs along it: the remainder is
// appended. Returns whether there is one.
static bool divide_outline(GArray *all, guint index, const Drawn *other, double same) {
  const SbCadPiece whole = g_array_index(all, Drawn, index).piece;
  const double length = 2 * g_array_index(all, Drawn, index).reach, quarter = atan(whole.bulge);
  double place[2];
  const bool along = overlaps(&whole, other, same, place);
  for (int end = 0; along && end < 2; end++) {
    const double part = place[end];
    if (part * length > same && (1 - part) * length > same) {
      const double x = end == 0 ? other->piece.x0 : other->piece.x1;
      const double y = end == 0 ? other->piece.y0 : other->piece.y1;
      const Drawn rest =
          drawn_of((SbCadPiece){x, y, whole.x1, whole.y1, tan((1 - part) * quarter)});
      g_array_index(all, Drawn, index) =
          drawn_of((SbCadPiece){whole.x0, whole.y0, x, y, tan(part * quarter)});
      g_array_append_val(all, rest);
      return true;
    }
  }
  return false;
}

// Returns whether two pieces are one, in any direction.
static bool is_same(const Drawn *a, const Drawn *b, double same) {
  const SbCadPiece *p = &a->piece, *q = &b->piece;
  const double along =
      fmax(hypot(p->x0 - q->x0, p->y0 - q->y0), hypot(p->x1 - q->x1, p->y1 - q->y1));
  const double back =
      fmax(hypot(p->x0 - q->x1, p->y0 - q->y1), hypot(p->x1 - q->x0, p->y1 - q->y0));
  return hypot(a->middle[0] - b->middle[0], a->middle[1] - b->middle[1]) <= same &&
         fmin(along, back) <= same;
}

// Returns the pieces without those of no length and those drawn twice, also in part, and counts the
// latter. Of more than NEAR_MAX pairs of pieces that are close together, the first are compared.
static GArray *tidied(const GArray *pieces, double same, guint *doubled) {
  g_autoptr(GArray) all = g_array_new(FALSE, FALSE, sizeof(Drawn));
  GArray *out = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  for (guint i = 0; i < pieces->len; i++) {
    const Drawn drawn = drawn_of(g_array_index(pieces, SbCadPiece, i));
    if (2 * drawn.reach > TINY) {
      g_array_append_val(all, drawn);
    }
  }
  guint near = 0;
  for (guint i = 0; i < all->len; i++) {
    bool single = true;
    for (guint k = 0; single && near < NEAR_MAX && k < all->len; k++) {
      const Drawn *piece = &g_array_index(all, Drawn, i), other = g_array_index(all, Drawn, k);
      const double x = piece->middle[0] - other.middle[0], y = piece->middle[1] - other.middle[1];
      const double reach = piece->reach + other.reach + same;
      if (i == k || x * x + y * y > reach * reach) {
        continue;
      }
      near++;
      if (all->len < OUTLINE_PIECES_MAX && divide_outline(all, i, &other, same)) {
        k--; // its other end
      } else {
        single = k > i || !is_same(piece, &other, same);
      }
    }
    if (single) {
      g_array_append_val(out, g_array_index(all, Drawn, i).piece);
    }
  }
  *doubled = all->len - out->len;
  return out;
}

// Appends the parts of `piece` above the axis; ends on it have y = 0 exactly.
static void clip(GArray *out, SbCadPiece piece, double gap) {
  // A circle that touches the axis within the gap does not cross it.
  const SbArc circle = piece.bulge != 0 ? sb_cad_circle(&piece) : (SbArc){0};
  const double dip = circle.radius - circle.centre[1], up = dip > 0 && dip <= gap ? dip : 0;
  piece.y0 = fabs(piece.y0 + up) <= gap ? 0 : piece.y0 + up;
  piece.y1 = fabs(piece.y1 + up) <= gap ? 0 : piece.y1 + up;
  double at[4] = {0, 1, 1, 1}; // where the piece is cut, as parts of its length
  int cuts = 1;
  if (piece.bulge == 0 && piece.y0 * piece.y1 < 0) {
    at[cuts++] = piece.y0 / (piece.y0 - piece.y1);
  } else if (piece.bulge != 0) {
    const SbArc arc = sb_cad_circle(&piece);
    const double half = up > 0 ? 0 : sqrt(pow(arc.radius, 2) - pow(arc.centre[1], 2));
    for (int side = -1; side <= 1 && half > 0; side += 2) {
      const double part = place_on(&piece, arc.centre[0] + side * half, 0, INFINITY);
      if (part > 1e-9 && part < 1 - 1e-9) {
        at[cuts++] = part;
      }
    }
    if (cuts == 3 && at[1] > at[2]) {
      memcpy(at + 1, (double[]){at[2], at[1]}, 2 * sizeof *at);
    }
  }
  at[cuts] = 1;
  double from[2] = {piece.x0, piece.y0};
  for (int i = 1; i <= cuts; i++) {
    double to[2] = {piece.x1, piece.y1}, high = 0, place[2];
    for (int k = 1; k <= 4; k++) { // its middle may touch the axis
      point_of(&piece, at[i - 1] + k / 4.0 * (at[i] - at[i - 1]), place);
      high = k < 4 ? fmax(high, place[1]) : high;
    }
    if (i < cuts) {
      to[0] = place[0];
      to[1] = 0;
    }
    if (high > gap) {
      const SbCadPiece kept = {from[0], from[1], to[0], to[1],
                               tan(atan(piece.bulge) * (at[i] - at[i - 1]))};
      g_array_append_val(out, kept);
    }
    memcpy(from, to, sizeof from);
  }
}

// Joins the piece `next` to the arc `last` if both are of one circle.
static bool join_arcs(SbCadPiece *last, const SbCadPiece *next) {
  const SbArc a = sb_cad_circle(last), b = sb_cad_circle(next);
  // Through the three ends, which are better known than either piece's curvature.
  const SbCadPiece both =
      sb_cad_arc((const double[2]){last->x0, last->y0}, (const double[2]){next->x0, next->y0},
                 (const double[2]){next->x1, next->y1});
  if (hypot(a.centre[0] - b.centre[0], a.centre[1] - b.centre[1]) > CONTINUED ||
      fabs(a.radius - b.radius) > CONTINUED || !(fabs(both.bulge) < 1) ||
      both.bulge * last->bulge < 0) {
    return false;
  }
  *last = both;
  return true;
}

// Returns whether the straight pieces from `first` to `last` of a chain follow one line forwards
// within STRAIGHT.
static bool is_straight(const GArray *chain, guint first, guint last) {
  const SbCadPiece *from = &g_array_index(chain, SbCadPiece, first);
  const SbCadPiece *to = &g_array_index(chain, SbCadPiece, last);
  const SbCadPiece line = {from->x0, from->y0, to->x1, to->y1, 0};
  double before = 0;
  bool good = line.x0 != line.x1 || line.y0 != line.y1;
  for (guint i = first + 1; good && i <= last; i++) {
    const SbCadPiece *piece = &g_array_index(chain, SbCadPiece, i);
    const double at = place_on(&line, piece->x0, piece->y0, STRAIGHT);
    good = at > before && at < 1;
    before = at;
  }
  return good;
}

// Joins pieces of one line or one circle, in place.
static void simplify(GArray *chain) {
  g_autoptr(GArray) all = g_array_copy(chain);
  guint kept = 0, first = 0; // first: of the pieces of `all` that the last one kept consists of
  for (guint i = 1; i < all->len; i++) {
    const SbCadPiece *next = &g_array_index(all, SbCadPiece, i);
    SbCadPiece *last = &g_array_index(chain, SbCadPiece, kept);
    if (last->bulge == 0 && next->bulge == 0 && is_straight(all, first, i)) {
      last->x1 = next->x1;
      last->y1 = next->y1;
    } else if (!(last->bulge * next->bulge > 0 && join_arcs(last, next))) {
      g_array_index(chain, SbCadPiece, ++kept) = *next;
      first = i;
    }
  }
  g_array_set_size(chain, kept + 1);
}

// Fills the body's profile from a chain, which it simplifies; `why` where that is none.
static void to_profile(SbCadBody *body, GArray *chain, bool closed) {
  simplify(chain);
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
static void half_section(SbCadBody *body, const GArray *chain, double gap) {
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
    body->why = above->len > 0 ? g_strdup("it crosses the axis more than twice") : NULL;
    return;
  }
  g_autoptr(GArray) turned = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  for (guint i = 0; i < above->len; i++) {
    g_array_append_val(turned, g_array_index(above, SbCadPiece, (begin + i) % above->len));
  }
  to_profile(body, turned, breaks == 0 && closes(chain, gap));
}

// Largest y of a chain.
static double top_of(const GArray *chain) {
  double high = -INFINITY;
  for (guint i = 0; i < chain->len; i++) {
    const SbCadPiece *piece = &g_array_index(chain, SbCadPiece, i);
    double middle[2]; // of the arc, which is enough to find the side
    point_of(piece, 0.5, middle);
    high = fmax(high, fmax(fmax(piece->y0, piece->y1), middle[1]));
  }
  return high;
}

// Warns about open chains, whose ends are pairs of points in `ends`: the largest distance from an
// end to the axis or the nearest other one is what `join` would have to bridge.
static void note_open(SbCad *cad, const char *name, const GArray *ends) {
  typedef double Point[2];
  const Point *at = (const Point *)(void *)ends->data;
  const guint count = ends->len;
  double largest = 0; // squared
  for (guint i = 0; i < count; i++) {
    double nearest = at[i][1] * at[i][1];
    for (guint k = 0; k < count; k++) {
      const double dx = at[i][0] - at[k][0], dy = at[i][1] - at[k][1], off = dx * dx + dy * dy;
      nearest = k != i && off < nearest ? off : nearest;
    }
    largest = fmax(largest, nearest);
  }
  char gap[SB_NUMBER_SIZE];
  cad->apart = fmax(cad->apart, sqrt(largest));
  sb_note_add(cad->warnings, "%s: %u line%s to no outline: ends are up to %s mm apart", name,
              count / 2, count > 2 ? "s that close" : " that closes",
              sb_number_round(gap, 1e3 * sqrt(largest), 3));
}

// Finds the closed outlines, and the open ones that end on the axis, as chains of SbCadPiece.
static GPtrArray *find_outlines(SbCad *cad, const GArray *pieces, const char *name, double gap) {
  g_autofree bool *used = g_new0(bool, pieces->len + 1);
  GPtrArray *outlines = g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref);
  g_autoptr(GArray) ends = g_array_new(FALSE, FALSE, 2 * sizeof(double));
  for (guint i = 0; i < pieces->len; i++) {
    // Pieces on the axis close what ends there; a centre line is no part of an outline.
    const SbCadPiece *piece = &g_array_index(pieces, SbCadPiece, i);
    used[i] = piece->bulge == 0 && fabs(piece->y0) <= gap && fabs(piece->y1) <= gap;
  }
  for (guint i = 0; i < pieces->len; i++) {
    if (used[i]) {
      continue;
    }
    used[i] = true;
    g_autoptr(GArray) chain = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
    g_array_append_val(chain, g_array_index(pieces, SbCadPiece, i));
    for (int way = 0; way < 2 && !closes(chain, gap); way++) {
      if (way == 1) {
        turn(chain);
      }
      while (!closes(chain, gap) && append_next(chain, pieces, used, gap)) {
      }
    }
    const SbCadPiece *first = &g_array_index(chain, SbCadPiece, 0);
    const SbCadPiece *last = &g_array_index(chain, SbCadPiece, chain->len - 1);
    if (closes(chain, gap) || (fabs(first->y0) <= gap && fabs(last->y1) <= gap)) {
      g_ptr_array_add(outlines, g_steal_pointer(&chain));
    } else {
      const double pair[2][2] = {{first->x0, first->y0}, {last->x1, last->y1}};
      g_array_append_vals(ends, pair, 2);
    }
  }
  if (ends->len > 0) {
    note_open(cad, name, ends);
  }
  return outlines;
}

// Returns whether a profile has no area: it is as thin as ends that are one point are far apart.
static bool is_degenerate(const GArray *profile, double gap) {
  const SbProfile points = {(void *)profile->data, profile->len, true};
  double length = 0;
  for (guint i = 1; i < profile->len; i++) {
    const SbProfilePoint *p = &g_array_index(profile, SbProfilePoint, i - 1), *q = p + 1;
    length += hypot(q->x - p->x, q->r - p->r);
  }
  return profile->len < 2 || fabs(sb_profile_area(&points)) <= gap * length;
}

void sb_cad_outlines(SbCad *cad, const GArray *pieces, const char *name, double gap) {
  if (pieces->len > OUTLINE_PIECES_MAX) {
    sb_note_add(cad->warnings, "%s: %u pieces, more than %d: left out", name, pieces->len,
                OUTLINE_PIECES_MAX);
    return;
  }
  guint doubled = 0, made = 0;
  const guint first = cad->bodies->len;
  g_autoptr(GArray) single = tidied(pieces, fmin(gap, DOUBLED), &doubled);
  g_autoptr(GPtrArray) outlines = find_outlines(cad, single, name, gap);
  if (doubled > 0) {
    sb_note_add(cad->warnings, "%s: %u piece%s drawn twice: left out", name, doubled,
                doubled > 1 ? "s" : "");
  }
  bool above = false;
  for (guint i = 0; i < outlines->len; i++) {
    above = above || top_of(outlines->pdata[i]) > gap;
  }
  for (guint i = 0; i < outlines->len; i++) {
    GArray *chain = outlines->pdata[i];
    if ((above && top_of(chain) <= gap) || cad->bodies->len >= SB_CAD_BODIES_MAX) {
      continue; // the other half of a whole section
    }
    for (guint k = 0; !above && k < chain->len; k++) {
      SbCadPiece *piece = &g_array_index(chain, SbCadPiece, k);
      *piece = (SbCadPiece){piece->x0, -piece->y0, piece->x1, -piece->y1, -piece->bulge};
    }
    g_autofree char *own = made > 0 ? g_strdup_printf("%s %u", name, made + 1) : g_strdup(name);
    SbCadBody *body = sb_cad_body_new(own);
    body->layer = first;
    half_section(body, chain, gap);
    if (body->why == NULL && is_degenerate(body->profile, gap)) {
      sb_cad_body_free(body);
      continue;
    }
    made++;
    g_ptr_array_add(cad->bodies, body);
  }
}

void sb_cad_section(SbCad *cad, SbCadBody *body, const GArray *pieces) {
  g_autoptr(SbCad) found = sb_cad_new("");
  const SbCadChoices none = {0};
  const SbCadBody *best = NULL;
  guint count = 0;
  sb_cad_outlines(found, pieces, body->name, CUT_GAP);
  sb_cad_settle(found, &none);
  for (guint i = 0; i < found->bodies->len; i++) {
    const SbCadBody *one = found->bodies->pdata[i];
    count += one->profile->len > 0;
    best = best == NULL || one->revolved.volume > best->revolved.volume ? one : best;
  }
  if (best == NULL || best->profile->len == 0) {
    const char *why = best != NULL && best->why != NULL ? best->why : "no outline closes";
    body->why = body->why != NULL ? body->why : g_strdup(why);
    return;
  }
  if (count > 1 || best->measured) {
    sb_note_add(cad->warnings,
                "%s: cut into %u pieces or hollow inside; the largest outline is its profile",
                body->name, count);
  }
  g_array_append_vals(body->profile, best->profile->data, best->profile->len);
  body->closed = best->closed;
  body->revolved = best->revolved;
}
