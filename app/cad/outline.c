// Pieces joined to outlines, and outlines made half-sections about the line y = 0.
#include "app/base/number.h"
#include "app/cad/cad_private.h"
#include "app/cad/profile.h"

#include <math.h>
#include <string.h>

// Comparing each end with each: a layer of more pieces is no seal's part.
enum { OUTLINE_PIECES_MAX = 5000, NEAR_MAX = 1000000 };

// Pieces that are shorter are ignored, and ends that are closer are one point; the largest distance
// between pieces that are drawn twice; of a circle from the next one that continues it, and of a
// line from points on it; ends that are one point where a body is cut; difference of halves that is
// reported [m].
static const double TINY = 1e-9, DOUBLED = 1e-6, CONTINUED = 1e-9, STRAIGHT = 1e-8, CUT_GAP = 1e-8,
                    HALVES = 2e-6;

static SbCadPiece reversed(SbCadPiece piece) {
  return (SbCadPiece){piece.x1, piece.y1, piece.x0, piece.y0, -piece.bulge};
}

// Length of a piece.
static double length_of(const SbCadPiece *piece) {
  const double chord = hypot(piece->x1 - piece->x0, piece->y1 - piece->y0);
  const double half = 2 * atan(fabs(piece->bulge));
  return half > 0 ? chord * half / sin(half) : chord;
}

// Returns whether the pieces follow one another from end to end, back to the first.
static bool closes(const GArray *chain, double gap) {
  double length = 0;
  bool good = true;
  for (guint i = 0; good && i < chain->len; i++) {
    const SbCadPiece *piece = &g_array_index(chain, SbCadPiece, i);
    const SbCadPiece *next = &g_array_index(chain, SbCadPiece, (i + 1) % chain->len);
    good = hypot(next->x0 - piece->x1, next->y0 - piece->y1) <= gap;
    length += length_of(piece);
  }
  return good && length > 2 * gap;
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

// Returns the largest distance of an end or a middle of the pieces `of` from the nearest one of
// `from`.
static double deviation(const GArray *of, const GArray *from) {
  double largest = 0;
  for (guint i = 0; i < 2 * of->len; i++) {
    double at[2], nearest = INFINITY;
    point_of(&g_array_index(of, SbCadPiece, i / 2), i % 2 / 2.0, at);
    for (guint k = 0; nearest > largest && k < from->len; k++) {
      const SbCadPiece *piece = &g_array_index(from, SbCadPiece, k);
      double off;
      const double place = sb_cad_place(piece, at[0], at[1], &off);
      off = place >= 0 && place <= 1 ? off
                                     : fmin(hypot(at[0] - piece->x0, at[1] - piece->y0),
                                            hypot(at[0] - piece->x1, at[1] - piece->y1));
      nearest = fmin(nearest, off);
    }
    largest = fmax(largest, nearest);
  }
  return largest;
}

// A piece with the circle about its middle in which it is.
typedef struct {
  SbCadPiece piece;
  double middle[2], reach;
  guint times;    // that it is drawn
  bool inside[2]; // its ends are within another piece
  guint part;     // of the graph: equal for edges that are connected
} Drawn;

static Drawn drawn_of(const SbCadPiece piece) {
  Drawn drawn = {.piece = piece, .reach = length_of(&piece) / 2, .times = 1};
  point_of(&piece, 0.5, drawn.middle);
  return drawn;
}

// Divides a piece of `all` (of Drawn) at an end of the piece `by`: the remainder is appended.
// Returns whether there is one.
static bool divide_outline(GArray *all, guint index, guint by, double same) {
  Drawn *whole = &g_array_index(all, Drawn, index), *other = &g_array_index(all, Drawn, by);
  const SbCadPiece piece = whole->piece, *ends = &other->piece;
  const double length = 2 * whole->reach, quarter = atan(piece.bulge);
  for (int end = 0; end < 2; end++) {
    const double part = end == 0 ? place_on(&piece, ends->x0, ends->y0, same)
                                 : place_on(&piece, ends->x1, ends->y1, same);
    if (part * length > same && (1 - part) * length > same) {
      double at[2];
      point_of(&piece, part, at);
      Drawn first = drawn_of((SbCadPiece){piece.x0, piece.y0, at[0], at[1], tan(part * quarter)});
      Drawn rest =
          drawn_of((SbCadPiece){at[0], at[1], piece.x1, piece.y1, tan((1 - part) * quarter)});
      other->inside[end] = true;
      first.inside[0] = whole->inside[0];
      rest.inside[1] = whole->inside[1];
      *whole = first;
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

// Returns the pieces (as Drawn) without those of no length, divided where others end on them or run
// along them; pieces that are one are counted in `times`. Of more than NEAR_MAX pairs of pieces
// that are close together, the first are compared.
static GArray *tidied(const GArray *pieces, double same) {
  g_autoptr(GArray) all = g_array_new(FALSE, FALSE, sizeof(Drawn));
  GArray *out = g_array_new(FALSE, FALSE, sizeof(Drawn));
  for (guint i = 0; i < pieces->len; i++) {
    const Drawn drawn = drawn_of(g_array_index(pieces, SbCadPiece, i));
    if (2 * drawn.reach > TINY) {
      g_array_append_val(all, drawn);
    }
  }
  guint near = 0;
  for (guint i = 0; i < all->len; i++) {
    for (guint k = 0; near < NEAR_MAX && k < all->len; k++) {
      Drawn *piece = &g_array_index(all, Drawn, i), *other = &g_array_index(all, Drawn, k);
      const double x = piece->middle[0] - other->middle[0], y = piece->middle[1] - other->middle[1];
      const double reach = piece->reach + other->reach + same;
      if (i == k || other->times == 0 || x * x + y * y > reach * reach) {
        continue;
      }
      near++;
      if (all->len < OUTLINE_PIECES_MAX && divide_outline(all, i, k, same)) {
        k--; // its other end
      } else if (k < i && is_same(piece, other, same)) {
        other->times++;
        piece->times = 0;
        break;
      }
    }
  }
  for (guint i = 0; i < all->len; i++) {
    if (g_array_index(all, Drawn, i).times > 0) {
      g_array_append_val(out, g_array_index(all, Drawn, i));
    }
  }
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

// ---- The plane graph of the pieces above the axis ----

// Edge i has the ends 2 i and 2 i + 1. An end is also the name of its edge when left from there.
typedef struct {
  GArray *edges; // of Drawn; those from `drawn` on are on the axis
  guint drawn;
  guint *node, *next; // of an end: the first end at its point, and the next one in a ring of those
} Graph;

// An outline, as a chain of pieces.
typedef struct {
  GArray *chain; // of SbCadPiece
  bool closed;   // else by the axis
  guint part;    // as in Drawn
  bool unsure;   // lines within it may be a bore
} Outline;

static void outline_free(gpointer data) {
  g_array_unref(((Outline *)data)->chain);
  g_free(data);
}

// Returns the edge as it is left from an end.
static SbCadPiece piece_from(const Graph *graph, guint end) {
  const SbCadPiece piece = g_array_index(graph->edges, Drawn, end / 2).piece;
  return end % 2 == 0 ? piece : reversed(piece);
}

// Makes the end `other`, which is alone at its point, one of those at the point of `end`.
static void join_end(Graph *graph, guint other, guint end) {
  graph->node[other] = graph->node[end];
  graph->next[other] = graph->next[end];
  graph->next[end] = other;
}

// Joins the ends at one point, and each end off the axis that is then alone to the nearest one
// within `gap`. Appends those that remain alone to `alone` (points).
static void join_ends(Graph *graph, double gap, GArray *alone) {
  const guint count = 2 * graph->drawn;
  for (guint pass = 0; pass < 2 * count; pass++) {
    const guint end = pass % count, last = pass < count ? end : count;
    const SbCadPiece piece = piece_from(graph, end);
    double nearest = pass < count ? TINY * TINY : gap * gap;
    guint best = count;
    if (pass < count) {
      graph->node[end] = graph->next[end] = end;
    } else if (piece.y0 == 0 || graph->next[end] != end) {
      continue;
    }
    const bool itself = length_of(&piece) > 2 * gap; // the gap of an arc
    for (guint k = 0; k < last; k++) {
      const SbCadPiece other = piece_from(graph, k);
      const double dx = other.x0 - piece.x0, dy = other.y0 - piece.y0, off = dx * dx + dy * dy;
      if (off <= nearest && k != end && (itself || k / 2 != end / 2)) {
        nearest = off;
        best = k;
      }
    }
    if (best < count) {
      join_end(graph, end, best);
    } else if (pass >= count) {
      g_array_append_vals(alone, &piece, 1);
    }
  }
}

// Numbers the parts of the graph, and closes those that end on the axis by edges along it.
static void close_by_axis(Graph *graph) {
  const guint count = 2 * graph->drawn;
  g_autofree guint *part = g_memdup2(graph->node, (count + 1) * sizeof *part);
  g_autofree bool *open = g_new0(bool, count + 1); // of the part: an odd number of edges ends
  for (bool more = true; more;) {
    more = false;
    for (guint i = 0; i < count; i += 2) {
      guint *a = &part[graph->node[i]], *b = &part[graph->node[i + 1]];
      more = more || *a != *b;
      *a = *b = MIN(*a, *b);
    }
  }
  for (guint end = 0; end < count; end++) {
    guint ends = 1;
    for (guint k = graph->next[end]; k != end; k = graph->next[k]) {
      ends++;
    }
    const guint own = part[graph->node[end]];
    open[own] = open[own] || (piece_from(graph, end).y0 == 0 && ends % 2 == 1);
    g_array_index(graph->edges, Drawn, end / 2).part = own;
  }
  for (guint end = 0; end < count; end++) {
    const SbCadPiece from = piece_from(graph, end);
    guint best = count;
    double x = INFINITY; // of the next one to the right
    for (guint k = 0; from.y0 == 0 && graph->node[end] == end && open[part[end]] && k < count;
         k++) {
      const SbCadPiece to = piece_from(graph, k);
      if (to.y0 == 0 && graph->node[k] == k && k != end && part[k] == part[end] &&
          to.x0 > from.x0 && to.x0 < x) {
        best = k;
        x = to.x0;
      }
    }
    if (best < count) {
      const Drawn axis = drawn_of((SbCadPiece){from.x0, 0, x, 0, 0});
      g_array_append_val(graph->edges, axis);
      join_end(graph, 2 * graph->edges->len - 2, end);
      join_end(graph, 2 * graph->edges->len - 1, best);
    }
  }
}

// An end, and the direction in which its edge leaves it.
typedef struct {
  double angle;
  guint end;
} Leaving;

static gint compare_leaving(gconstpointer a, gconstpointer b) {
  const double x = ((const Leaving *)a)->angle, y = ((const Leaving *)b)->angle;
  return (x > y) - (x < y);
}

// Orders the ends at each point counter-clockwise, by directions at a small distance, where tangent
// edges differ. The boundary of a face, on its right, then goes on from the edge left from `end`
// with that left from next[end ^ 1].
static void turn_ends(const Graph *graph) {
  g_autoptr(GArray) all = g_array_new(FALSE, FALSE, sizeof(Leaving));
  for (guint end = 0; end < 2 * graph->edges->len; end++) {
    double near = INFINITY;
    g_array_set_size(all, 0);
    for (guint k = end; graph->node[end] == end && (k != end || all->len == 0);
         k = graph->next[k]) {
      g_array_append_val(all, ((Leaving){0, k}));
      near = fmin(near, g_array_index(graph->edges, Drawn, k / 2).reach);
    }
    for (guint i = 0; i < all->len; i++) {
      Leaving *one = &g_array_index(all, Leaving, i);
      const SbCadPiece piece = piece_from(graph, one->end);
      double at[2];
      point_of(&piece, near / length_of(&piece), at);
      one->angle = atan2(at[1] - piece.y0, at[0] - piece.x0);
    }
    g_array_sort(all, compare_leaving);
    for (guint i = 0; i < all->len; i++) {
      graph->next[g_array_index(all, Leaving, i).end] =
          g_array_index(all, Leaving, (i + 1) % all->len).end;
    }
  }
}

// Twice the area between a piece and the point (x, 0), positive if it is on the left of the piece.
static double area_of(const SbCadPiece *p, double x) {
  const SbArc arc = p->bulge != 0 ? sb_cad_circle(p) : (SbArc){0};
  return (p->x0 - x) * p->y1 - (p->x1 - x) * p->y0 +
         arc.radius * arc.radius * (arc.sweep - sin(arc.sweep));
}

// Appends a cycle of edges without its edges on the axis as an outline, unless it has no area: it
// is as thin as ends that are one point are far apart.
static void add_outline(GPtrArray *outlines, const Graph *graph, const guint *cycle, guint count,
                        double gap) {
  guint first = 0;
  bool closed = true;
  for (guint i = 0; i < count; i++) {
    if (cycle[i] / 2 >= graph->drawn) {
      closed = false;
      first = cycle[(i + 1) % count] / 2 < graph->drawn ? i + 1 : first;
    }
  }
  g_autoptr(GArray) chain = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  double area = 0, length = 0;
  for (guint i = 0; i < count; i++) {
    const guint end = cycle[(first + i) % count];
    const SbCadPiece piece = piece_from(graph, end);
    if (end / 2 < graph->drawn) {
      area += area_of(&piece, piece_from(graph, cycle[0]).x0);
      length += length_of(&piece);
      g_array_append_val(chain, piece);
    }
  }
  if (fabs(area) > 2 * gap * length) {
    Outline *outline = g_new(Outline, 1);
    const guint own = cycle[first % count] / 2;
    *outline = (Outline){g_steal_pointer(&chain), closed,
                         g_array_index(graph->edges, Drawn, own).part, false};
    g_ptr_array_add(outlines, outline);
  }
}

// Appends the outer boundary of the faces of the graph of `edges` (of Drawn, changed) to `outlines`
// and ends that meet no other to `alone`. Returns the edges between two faces.
static GArray *add_boundary(GPtrArray *outlines, GArray *alone, GArray *edges, double gap) {
  const gsize most = 6 * (gsize)edges->len + 1; // ends, with those of edges on the axis
  g_autofree guint *node = g_new0(guint, most), *next = g_new0(guint, most);
  g_autofree guint *face = g_new0(guint, most), *place = g_new0(guint, most);
  g_autoptr(GArray) outer = g_array_new(FALSE, TRUE, sizeof(bool));
  g_autoptr(GArray) cycle = g_array_new(FALSE, FALSE, sizeof(guint));
  Graph graph = {edges, edges->len, node, next};
  join_ends(&graph, gap, alone);
  close_by_axis(&graph);
  turn_ends(&graph);
  g_array_set_size(outer, 1);
  for (guint begin = 0; begin < 2 * edges->len; begin++) {
    double area = 0;
    for (guint end = begin; face[end] == 0; end = next[end ^ 1U]) {
      const SbCadPiece piece = piece_from(&graph, end);
      face[end] = outer->len;
      area += area_of(&piece, piece_from(&graph, begin).x0);
    }
    // The outer face is on the right of its counter-clockwise boundary, which may pass a point
    // twice.
    const bool is_outer = area > 0;
    const guint own = outer->len;
    if (face[begin] == own) {
      g_array_append_val(outer, is_outer);
    }
    for (guint end = begin, i = 0; face[begin] == own && is_outer && (i == 0 || end != begin);
         end = next[end ^ 1U], i++) {
      place[node[end]] = cycle->len + 1;
      g_array_append_val(cycle, end);
      const guint at = place[node[end ^ 1U]];
      if (at > 0) {
        const guint *ends = &g_array_index(cycle, guint, at - 1);
        add_outline(outlines, &graph, ends, cycle->len - at + 1, gap);
        for (guint k = 0; k < cycle->len - at + 1; k++) {
          place[node[ends[k]]] = 0;
        }
        g_array_set_size(cycle, at - 1);
      }
    }
  }
  GArray *inner = g_array_new(FALSE, FALSE, sizeof(Drawn));
  for (guint i = 0; i < graph.drawn; i++) {
    const guint left = face[2 * i], right = face[2 * i + 1];
    if (left != right && !g_array_index(outer, bool, left) && !g_array_index(outer, bool, right)) {
      g_array_append_val(inner, g_array_index(edges, Drawn, i));
    }
  }
  return inner;
}

// ---- Bodies ----

// What is drawn above the axis, or below it.
typedef struct {
  GPtrArray *outlines; // of Outline
  GArray *pieces;      // of SbCadPiece: of the outlines
  GArray *alone;       // of SbCadPiece: they begin at an end that meets no other
  guint doubled, inner;
} Half;

// Warns about the ends of open chains: the largest distance from an end to the axis or the nearest
// other one is what `join` would have to bridge.
static void note_open(SbCad *cad, const char *name, const GArray *ends) {
  const SbCadPiece *at = (const SbCadPiece *)(void *)ends->data;
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

// Appends the outlines of closed entities. Edges that two of them share bound neither the material
// of both nor a recess, an outline within another one at its edge.
static void add_closed(Half *half, const GArray *pieces, double gap, double same) {
  g_autoptr(GArray) all = tidied(pieces, same);
  g_autoptr(GArray) edges = g_array_new(FALSE, FALSE, sizeof(Drawn));
  for (guint i = 0; i < all->len; i++) {
    if (g_array_index(all, Drawn, i).times % 2 == 1) {
      g_array_append_val(edges, g_array_index(all, Drawn, i));
    }
  }
  for (guint count = 0; count != edges->len;) {
    count = edges->len;
    GArray *inner = add_boundary(half->outlines, half->alone, edges, gap);
    g_array_unref(edges);
    edges = inner;
  }
  half->inner += edges->len; // they cross themselves
}
// Returns whether an outline is one of `others` (of GArray of SbCadPiece).
static bool is_known(const GPtrArray *others, const GArray *chain, double same) {
  bool known = false;
  for (guint i = 0; !known && i < others->len; i++) {
    const GArray *other = others->pdata[i];
    known = deviation(chain, other) <= same && deviation(other, chain) <= same;
  }
  return known;
}

// Appends the outlines of lines that are no closed entities: the outer boundary of those that are
// connected. Lines within it are edges of shoulders if they are drawn twice, across the axis, or
// from the middle of a line to that of another; else it is unsure.
static void add_open(Half *half, const GArray *pieces, double gap, double same) {
  g_autoptr(GArray) edges = tidied(pieces, same);
  g_autoptr(GPtrArray) known = g_ptr_array_new();
  for (guint i = 0; i < half->outlines->len; i++) {
    g_ptr_array_add(known, ((Outline *)half->outlines->pdata[i])->chain);
  }
  for (guint i = 0; i < edges->len; i++) {
    half->doubled += g_array_index(edges, Drawn, i).times - 1;
  }
  g_autoptr(GArray) inner = add_boundary(half->outlines, half->alone, edges, gap);
  for (guint i = 0; i < inner->len; i++) {
    const Drawn *edge = &g_array_index(inner, Drawn, i);
    const SbCadPiece *piece = &edge->piece;
    const bool sure = edge->times > 1 || (edge->inside[0] && edge->inside[1]) ||
                      (piece->bulge == 0 && fabs(piece->x1 - piece->x0) <= same);
    half->doubled -= edge->times - 1;
    half->inner += edge->times == 1;
    for (guint k = known->len; !sure && k < half->outlines->len; k++) {
      Outline *outline = half->outlines->pdata[k];
      outline->unsure = outline->unsure || outline->part == edge->part;
    }
  }
  for (guint k = half->outlines->len; k-- > known->len;) {
    const GArray *chain = ((Outline *)half->outlines->pdata[k])->chain;
    if (is_known(known, chain, same)) {
      half->doubled += chain->len;
      g_ptr_array_remove_index(half->outlines, k);
    }
  }
}

// Finds the outlines of the entities (of GArray of SbCadPiece) above the axis, or below it and
// mirrored (`side` -1).
static void read_half(Half *half, const GPtrArray *entities, int side, double gap) {
  const double same = fmin(gap, DOUBLED);
  g_autoptr(GArray) closed = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  g_autoptr(GArray) open = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  g_autoptr(GPtrArray) known = g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref);
  half->outlines = g_ptr_array_new_with_free_func(outline_free);
  half->pieces = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  half->alone = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  for (guint i = 0; i < entities->len; i++) {
    const GArray *entity = entities->pdata[i];
    g_autoptr(GArray) above = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
    for (guint k = 0; k < entity->len; k++) {
      const SbCadPiece p = g_array_index(entity, SbCadPiece, k);
      clip(above, (SbCadPiece){p.x0, side * p.y0, p.x1, side * p.y1, side * p.bulge}, gap);
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
  add_closed(half, closed, gap, same);
  add_open(half, open, gap, same);
  for (guint i = 0; i < half->outlines->len; i++) {
    const GArray *chain = ((Outline *)half->outlines->pdata[i])->chain;
    g_array_append_vals(half->pieces, chain->data, chain->len);
  }
}

static void half_clear(Half *half) {
  g_ptr_array_unref(half->outlines);
  g_array_unref(half->pieces);
  g_array_unref(half->alone);
}

// Adds warnings on what was ignored in the half that is used, and on the other one.
static void note_half(SbCad *cad, const char *name, const Half *half, const Half *other,
                      double gap) {
  char number[SB_NUMBER_SIZE];
  if (half->alone->len > 0) {
    note_open(cad, name, half->alone);
  }
  if (half->doubled > 0) {
    sb_note_add(cad->warnings, "%s: %u piece%s drawn twice: left out", name, half->doubled,
                half->doubled > 1 ? "s" : "");
  }
  if (half->inner > 0) {
    sb_note_add(cad->warnings, "%s: %u line%s within the outline, read as no bore or cavity", name,
                half->inner, half->inner > 1 ? "s" : "");
  }
  const double apart =
      half->pieces->len > 0 && other->pieces->len > 0
          ? fmax(deviation(half->pieces, other->pieces), deviation(other->pieces, half->pieces))
          : 0;
  if (apart > fmax(2 * gap, HALVES)) {
    sb_note_add(cad->warnings,
                "%s: the halves above and below the axis differ by up to %s mm: that above is used",
                name, sb_number_round(number, 1e3 * apart, 3));
  }
}

void sb_cad_outlines(SbCad *cad, const GPtrArray *entities, const char *name, double gap) {
  guint pieces = 0, made = 0;
  for (guint i = 0; i < entities->len; i++) {
    pieces += ((const GArray *)entities->pdata[i])->len;
  }
  if (pieces > OUTLINE_PIECES_MAX) {
    sb_note_add(cad->warnings, "%s: %u pieces, more than %d: left out", name, pieces,
                OUTLINE_PIECES_MAX);
    return;
  }
  const guint first = cad->bodies->len;
  Half half[2] = {0};
  read_half(&half[0], entities, 1, gap);
  read_half(&half[1], entities, -1, gap);
  const int used =
      half[0].outlines->len == 0 && (half[1].outlines->len > 0 || half[0].alone->len == 0);
  note_half(cad, name, &half[used], &half[1 - used], gap);
  for (guint i = 0; i < half[used].outlines->len && cad->bodies->len < SB_CAD_BODIES_MAX; i++) {
    const Outline *outline = half[used].outlines->pdata[i];
    g_autofree char *own = made > 0 ? g_strdup_printf("%s %u", name, made + 1) : g_strdup(name);
    SbCadBody *body = sb_cad_body_new(own);
    body->layer = first;
    if (outline->unsure) {
      body->why =
          g_strdup("lines within its outline are edges or a bore: draw the outline, or that "
                   "of the bore as well, as a closed polyline");
    } else {
      to_profile(body, outline->chain, outline->closed);
    }
    made++;
    g_ptr_array_add(cad->bodies, body);
  }
  half_clear(&half[0]);
  half_clear(&half[1]);
}

void sb_cad_section(SbCad *cad, SbCadBody *body, const GArray *pieces) {
  g_autoptr(SbCad) found = sb_cad_new("");
  const SbCadChoices none = {0};
  const SbCadBody *best = NULL;
  guint count = 0;
  const gpointer all[] = {(gpointer)pieces};
  sb_cad_outlines(found, &(GPtrArray){(gpointer *)all, 1}, body->name, CUT_GAP);
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
