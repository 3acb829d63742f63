// Pieces joined to outlines, and outlines made half-sections about the line y = 0.
#include "app/cad/cad_private.h"

// Largest distances [m]: of pieces that are drawn twice; of pieces that continue a circle, a line;
// of ends that are one point where a body is cut; of halves without a warning.
static const double DOUBLED = 1e-6, CONTINUED = 1e-9, STRAIGHT = 1e-8, CUT = 1e-8, HALVES = 2e-6;

// Returns whether the pieces follow one another from end to end, back to the first.
static bool closes(const GArray *chain, double gap) {
  double length = 0;
  bool good = true;
  for (guint i = 0; good && i < chain->len; i++) {
    const SbPiece *piece = &g_array_index(chain, SbPiece, i);
    const SbPiece *next = &g_array_index(chain, SbPiece, (i + 1) % chain->len);
    good = hypot(next->x0 - piece->x1, next->y0 - piece->y1) <= gap;
    length += sb_piece_length(piece);
  }
  return good && length > 2 * gap;
}

// Returns the largest distance of ends and middles of the pieces `of` from the nearest of `from`.
static double deviation(const GArray *of, const GArray *from) {
  double largest = 0;
  for (guint i = 0; i < 2 * of->len; i++) {
    double at[2], nearest = INFINITY;
    sb_piece_point(&g_array_index(of, SbPiece, i / 2), i % 2 / 2.0, at);
    for (guint k = 0; nearest > largest && k < from->len; k++) {
      const SbPiece *piece = &g_array_index(from, SbPiece, k);
      double off;
      const double place = sb_piece_place(piece, at[0], at[1], &off);
      off = place >= 0 && place <= 1 ? off
                                     : fmin(hypot(at[0] - piece->x0, at[1] - piece->y0),
                                            hypot(at[0] - piece->x1, at[1] - piece->y1));
      nearest = fmin(nearest, off);
    }
    largest = fmax(largest, nearest);
  }
  return largest;
}

// Returns how far an arc dips below the axis between its ends; 0: by more than `gap`, it crosses
// it.
static double dip_of(const SbPiece *piece, double gap) {
  const SbArc arc = piece->bulge != 0 ? sb_piece_arc(piece) : (SbArc){0};
  const double dip = arc.radius - arc.centre[1];
  double off;
  const double place =
      dip > 0 && dip <= gap ? sb_piece_place(piece, arc.centre[0], -dip, &off) : -1;
  return place > 0 && place < 1 ? dip : 0;
}

// Appends the parts of `piece` above the axis; ends on it have y = 0 exactly, where an arc that
// would dip below it within the gap becomes tangent to it.
static void clip(GArray *out, SbPiece piece, double gap) {
  piece.y0 = fabs(piece.y0) <= gap ? 0 : piece.y0;
  piece.y1 = fabs(piece.y1) <= gap ? 0 : piece.y1;
  const double dx = copysign(1, piece.bulge) * (piece.x1 - piece.x0), y = piece.y0 + piece.y1;
  const bool touches = dip_of(&piece, gap) > 0;
  if (touches && y > 0 && fmin(piece.y0, piece.y1) == 0) {
    piece.bulge = copysign(y / (hypot(dx, y) + dx), piece.bulge);
  }
  double at[4] = {0, 1, 1, 1}; // where the piece is cut, as parts of its length
  int cuts = 1;
  if (piece.bulge == 0 && piece.y0 * piece.y1 < 0) {
    at[cuts++] = piece.y0 / (piece.y0 - piece.y1);
  } else if (piece.bulge != 0) {
    const SbArc arc = sb_piece_arc(&piece);
    const double half = touches ? 0 : sqrt(pow(arc.radius, 2) - pow(arc.centre[1], 2));
    for (int side = -1; side <= 1 && half > 0; side += 2) {
      double off;
      const double part = sb_piece_place(&piece, arc.centre[0] + side * half, 0, &off);
      if (part > 1e-9 && part < 1 - 1e-9) {
        at[cuts++] = part;
      }
    }
    if (cuts == 3 && at[1] > at[2]) {
      memcpy(at + 1, (double[]){at[2], at[1]}, 2 * sizeof *at);
    }
  }
  double from[2] = {piece.x0, piece.y0};
  for (int i = 1; i <= cuts; i++) {
    double high = 0, place[2];
    for (int k = 0; k <= 4; k++) { // its middle may touch the axis
      sb_piece_point(&piece, at[i - 1] + k / 4.0 * (at[i] - at[i - 1]), place);
      high = fmax(high, place[1]);
    }
    const double to[2] = {i < cuts ? place[0] : piece.x1, i < cuts ? 0 : piece.y1};
    const double bulge = tan(atan(piece.bulge) * (at[i] - at[i - 1]));
    if (high > gap) {
      g_array_append_vals(out, &(SbPiece){from[0], from[1], to[0], to[1], bulge}, 1);
    }
    memcpy(from, to, sizeof from);
  }
}

// Joins runs of pieces of one line or circle in place; `within` > 0: of any so close to an arc [m].
static void simplify(GArray *chain, double within) {
  g_autoptr(GArray) all = g_array_copy(chain);
  guint kept = 0, first = 0; // first: of the pieces of `all` that the last one kept consists of
  for (guint i = 1; i < all->len; i++) {
    const SbPiece *piece = &g_array_index(all, SbPiece, 0);
    const SbPiece *from = &piece[first], *to = &piece[i];
    const double begin[2] = {from->x0, from->y0}, end[2] = {to->x1, to->y1};
    double middle[2];
    sb_piece_point(&piece[(first + i + 1) / 2], 0, middle);
    const bool line = within == 0 && from->bulge == 0 && to->bulge == 0;
    SbPiece one = sb_cad_arc(begin, middle, end);
    one.bulge = line ? 0 : one.bulge;
    const double least = within > 0 ? within : line ? STRAIGHT : CONTINUED;
    if ((line || within > 0 || from->bulge * to->bulge > 0) && fabs(one.bulge) < 1 &&
        (one.x0 != one.x1 || one.y0 != one.y1) &&
        deviation(&(GArray){(gchar *)from, i + 1 - first}, &(GArray){(gchar *)&one, 1}) <= least) {
      g_array_index(chain, SbPiece, kept) = one;
    } else {
      g_array_index(chain, SbPiece, ++kept) = *to;
      first = i;
    }
  }
  g_array_set_size(chain, kept + 1);
}

// Fills the body's profile from a chain, which it simplifies; `why` where that is none.
static void to_profile(SbCadBody *body, GArray *chain, bool closed) {
  g_autoptr(GArray) drawn = g_array_copy(chain);
  for (int pass = 0; pass < 1 + closed; pass++) { // again from another p, whose end is a corner
    const SbPiece first = g_array_index(chain, SbPiece, 0);
    g_array_remove_index(chain, 0);
    g_array_insert_val(chain, pass == 0 ? 0 : chain->len, first);
    simplify(chain, 0);
  }
  if (chain->len + 1 > SB_PROFILE_MAX) {
    simplify(drawn, SB_CAD_TOLERANCE);
    chain = drawn;
  }
  if (chain->len + 1 > SB_PROFILE_MAX) {
    body->why = g_strdup_printf("its half-section has %u pieces, more than %d", chain->len,
                                SB_PROFILE_MAX - 1);
    return;
  }
  for (guint i = 0; i < chain->len; i++) {
    const SbPiece *p = &g_array_index(chain, SbPiece, i);
    g_array_append_vals(body->profile, &(SbProfilePoint){p->x0, fmax(p->y0, 0), p->bulge}, 1);
  }
  if (!closed) {
    const SbPiece *last = &g_array_index(chain, SbPiece, chain->len - 1);
    g_array_append_vals(body->profile, &(SbProfilePoint){last->x1, 0, 0}, 1);
  }
  body->closed = closed;
}

static void outline_free(gpointer data) {
  g_array_unref(((SbCadOutline *)data)->chain);
  g_free(data);
}

// Warns about the ends of open chains: the largest distance from an end to the axis or the nearest
// other one is what `join` would have to bridge.
static void note_open(SbCad *cad, const char *name, const GArray *ends) {
  const SbPiece *at = (const SbPiece *)(void *)ends->data;
  double largest = 0; // squared
  for (guint i = 0; i < ends->len; i++) {
    double nearest = at[i].y0 * at[i].y0;
    for (guint k = 0; k < ends->len; k++) {
      const double dx = at[i].x0 - at[k].x0, dy = at[i].y0 - at[k].y0, off = dx * dx + dy * dy;
      nearest = k != i && off < nearest ? off : nearest;
    }
    largest = fmax(largest, nearest);
  }
  char gap[SB_NUMBER_SIZE];
  cad->apart = fmax(cad->apart, sqrt(largest));
  sb_note_add(cad->warnings, "%s: %u line%s to no outline: ends are up to %s mm apart", name,
              (ends->len + 1) / 2, ends->len > 2 ? "s that close" : " that closes",
              sb_number_round(gap, 1e3 * sqrt(largest), 3));
}

// Returns whether an outline is one of `others` (of GArray of SbPiece).
static bool is_known(const GPtrArray *others, const GArray *chain, double same) {
  bool known = false;
  for (guint i = 0; !known && i < others->len; i++) {
    const GArray *other = others->pdata[i];
    known = deviation(chain, other) <= same && deviation(other, chain) <= same;
  }
  return known;
}

// Finds the outlines of entities (of GArray of SbPiece) above the axis; `side` -1: below, mirrored.
static void read_half(SbCadLines *half, const GPtrArray *entities, int side, double gap) {
  const double same = fmin(gap, DOUBLED);
  g_autoptr(GArray) closed = g_array_new(FALSE, FALSE, sizeof(SbPiece));
  g_autoptr(GArray) open = g_array_new(FALSE, FALSE, sizeof(SbPiece));
  g_autoptr(GPtrArray) known = g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref);
  half->outlines = g_ptr_array_new_with_free_func(outline_free);
  half->pieces = g_array_new(FALSE, FALSE, sizeof(SbPiece));
  half->alone = g_array_new(FALSE, FALSE, sizeof(SbPiece));
  for (guint i = 0; i < entities->len; i++) {
    const GArray *entity = entities->pdata[i];
    g_autoptr(GArray) above = g_array_new(FALSE, FALSE, sizeof(SbPiece));
    g_autoptr(GArray) mirrored = g_array_copy(entities->pdata[i]);
    SbPiece *piece = (SbPiece *)(void *)mirrored->data;
    double up = 0; // a curve that dips below the axis within the gap touches it
    for (guint k = 0; k < entity->len; k++) {
      piece[k] = (SbPiece){piece[k].x0, side * piece[k].y0, piece[k].x1, side * piece[k].y1,
                           side * piece[k].bulge};
      up = fmax(up, dip_of(&piece[k], gap));
    }
    for (guint k = 0; k < entity->len; k++) {
      piece[k].y0 += up;
      piece[k].y1 += up;
      clip(above, piece[k], gap);
    }
    const bool own = closes(entity, gap);
    if (own && above->len > 0 && is_known(known, above, same)) {
      half->doubled += above->len;
      continue;
    }
    g_array_append_vals(own ? closed : open, above->data, above->len);
    if (own) {
      g_ptr_array_add(known, g_steal_pointer(&above));
    }
  }
  sb_cad_add_closed(half, closed, gap, same);
  g_ptr_array_set_size(known, 0);
  for (guint i = 0; i < half->outlines->len; i++) {
    g_ptr_array_add(known, g_array_ref(((SbCadOutline *)half->outlines->pdata[i])->chain));
  }
  sb_cad_add_open(half, open, gap, same);
  for (guint i = half->outlines->len; i-- > known->len;) {
    const GArray *chain = ((SbCadOutline *)half->outlines->pdata[i])->chain;
    if (is_known(known, chain, same)) {
      half->doubled += chain->len;
      g_ptr_array_remove_index(half->outlines, i);
    }
  }
  for (guint i = 0; i < half->outlines->len; i++) {
    const GArray *chain = ((SbCadOutline *)half->outlines->pdata[i])->chain;
    g_array_append_vals(half->pieces, chain->data, chain->len);
  }
}

// Adds warnings on what was ignored in the half that is used, and on the other one.
static void note_half(SbCad *cad, const char *name, const SbCadLines *half, const SbCadLines *other,
                      double gap) {
  char number[SB_NUMBER_SIZE];
  if (half->alone->len > 0) {
    note_open(cad, name, half->alone);
  }
  if (half->doubled > 0) {
    sb_note_add(cad->warnings, "%s: %u piece%s drawn twice: left out", name, half->doubled,
                half->doubled > 1 ? "s" : "");
  }
  if (half->crossed > 0) {
    sb_note_add(cad->warnings, "%s: a closed line of %u pieces crosses itself or encloses no area",
                name, half->crossed);
  }
  if (half->inner > 0) {
    sb_note_add(cad->warnings, "%s: %u line%s within the outline, read as no bore or cavity", name,
                half->inner, half->inner > 1 ? "s" : "");
  }
  const double apart =
      half->pieces->len > 0 && other->pieces->len > 0
          ? fmax(deviation(half->pieces, other->pieces), deviation(other->pieces, half->pieces))
          : 0;
  if (apart > 0 && half->outlines->len != other->outlines->len) {
    sb_note_add(cad->warnings,
                "%s: outlines above and below the axis: %u and %u; those above are used", name,
                half->outlines->len, other->outlines->len);
  } else if (apart > fmax(2 * gap, HALVES)) {
    sb_note_add(cad->warnings,
                "%s: the halves above and below the axis differ by up to %s mm: that above is used",
                name, sb_number_round(number, 1e3 * apart, 3));
  }
}

void sb_cad_outlines(SbCad *cad, const GPtrArray *entities, const char *name, double gap) {
  guint pieces = 0;
  for (guint i = 0; i < entities->len; i++) {
    pieces += ((const GArray *)entities->pdata[i])->len;
  }
  if (pieces > SB_CAD_PIECES_MAX) {
    sb_note_add(cad->warnings, "%s: %u pieces, more than %d: left out", name, pieces,
                SB_CAD_PIECES_MAX);
    return;
  }
  const guint first = cad->bodies->len;
  SbCadLines half[2] = {0};
  read_half(&half[0], entities, 1, gap);
  read_half(&half[1], entities, -1, gap);
  const int used = half[0].outlines->len == 0 &&
                   (half[1].outlines->len > 0 || half[0].alone->len + half[0].crossed == 0);
  note_half(cad, name, &half[used], &half[1 - used], gap);
  for (guint i = 0; i < half[used].outlines->len && cad->bodies->len < SB_CAD_BODIES_MAX; i++) {
    const SbCadOutline *outline = half[used].outlines->pdata[i];
    g_autofree char *own = i > 0 ? g_strdup_printf("%s %u", name, i + 1) : g_strdup(name);
    SbCadBody *body = sb_cad_body_new(own);
    body->layer = first;
    if (outline->unsure) {
      body->why =
          g_strdup("lines within its outline are edges or a bore: draw the outline, or that "
                   "of the bore as well, as a closed polyline");
    } else {
      to_profile(body, outline->chain, outline->closed);
    }
    g_ptr_array_add(cad->bodies, body);
  }
  for (int k = 0; k < 2; k++) {
    g_ptr_array_unref(half[k].outlines);
    g_array_unref(half[k].pieces);
    g_array_unref(half[k].alone);
  }
}

void sb_cad_section(SbCad *cad, SbCadBody *body, const GArray *pieces) {
  g_autoptr(SbCad) found = sb_cad_new("");
  const SbCadBody *best = NULL;
  guint count = 0;
  const gpointer all[] = {(gpointer)pieces};
  sb_cad_outlines(found, &(GPtrArray){(gpointer *)all, 1}, body->name, CUT);
  sb_cad_settle(found, &(const SbCadChoices){0});
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
    sb_note_add(cad->warnings, "%s: %s", body->name,
                count > 1 ? "cut into several pieces; the largest one is its half-section"
                          : "its half-section leaves out a cavity or port within it");
  }
  g_array_append_vals(body->profile, best->profile->data, best->profile->len);
  body->closed = best->closed;
  body->revolved = best->revolved;
  body->hollow = best->revolved.volume - best->solid.volume;
}
