// The plane graph of the pieces of a layer, and the outlines that bound its faces.
#include "app/cad/cad_private.h"

#include <stdlib.h>

// Pairs of pieces that are close together and compared.
enum { NEAR_MAX = 1000000 };

// Ends that are closer are one point, and shorter pieces are ignored [m].
static const double TINY = 1e-9;

// A piece with the circle about its middle in which it is.
typedef struct {
  SbPiece piece;
  double middle[2], reach;
  guint times;    // that it is drawn
  bool inside[2]; // its ends are within another piece
  guint part;     // of the graph: equal for edges that are connected
} Drawn;

static Drawn drawn_of(const SbPiece piece) {
  Drawn drawn = {.piece = piece, .reach = sb_piece_length(&piece) / 2, .times = 1};
  sb_piece_point(&piece, 0.5, drawn.middle);
  return drawn;
}

// Divides a piece of `all` (of Drawn) at an end of the piece `by` that is on it; false: none is.
static bool divide_outline(GArray *all, guint index, guint by, double same) {
  Drawn *whole = &g_array_index(all, Drawn, index), *other = &g_array_index(all, Drawn, by);
  const SbPiece piece = whole->piece, *ends = &other->piece;
  const double length = 2 * whole->reach, quarter = atan(piece.bulge);
  for (int end = 0; end < 2; end++) {
    double at[2], off;
    sb_piece_point(ends, end, at);
    const double part = sb_piece_place(&piece, at[0], at[1], &off);
    if (off <= same && part * length > same && (1 - part) * length > same) {
      sb_piece_point(&piece, part, at);
      Drawn first = drawn_of((SbPiece){piece.x0, piece.y0, at[0], at[1], tan(part * quarter)});
      Drawn rest = drawn_of((SbPiece){at[0], at[1], piece.x1, piece.y1, tan((1 - part) * quarter)});
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
  const SbPiece *p = &a->piece, *q = &b->piece;
  const double one = fmax(hypot(p->x0 - q->x0, p->y0 - q->y0), hypot(p->x1 - q->x1, p->y1 - q->y1));
  const double two = fmax(hypot(p->x0 - q->x1, p->y0 - q->y1), hypot(p->x1 - q->x0, p->y1 - q->y0));
  return hypot(a->middle[0] - b->middle[0], a->middle[1] - b->middle[1]) <= same &&
         fmin(one, two) <= same;
}

// Returns the pieces (as Drawn) without those of no length, divided where others end on them or run
// along them; pieces that are one are counted in `times`, and vanish if `odd` and that is even. Of
// more than NEAR_MAX pairs of pieces that are close together, the first are compared.
static GArray *tidied(const GArray *pieces, double same, bool odd) {
  GArray *all = g_array_new(FALSE, FALSE, sizeof(Drawn));
  for (guint i = 0; i < pieces->len; i++) {
    const Drawn drawn = drawn_of(g_array_index(pieces, SbPiece, i));
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
      if (all->len < SB_CAD_PIECES_MAX && divide_outline(all, i, k, same)) {
        k--; // its other end
      } else if (k < i && is_same(piece, other, same)) {
        other->times++;
        piece->times = 0;
        break;
      }
    }
  }
  for (guint i = all->len; i-- > 0;) {
    const guint times = g_array_index(all, Drawn, i).times;
    if (times == 0 || (odd && times % 2 == 0)) {
      g_array_remove_index(all, i);
    }
  }
  return all;
}

// Edge i has the ends 2 i and 2 i + 1. An end is also the name of its edge when left from there.
typedef struct {
  GArray *edges; // of Drawn; those from `drawn` on are on the axis
  guint drawn;
  guint *node, *next; // of an end: the first end at its point; the next one, counter-clockwise
  guint *ends;        // of a node: number of its ends
} Graph;

// Returns the edge as it is left from an end.
static SbPiece piece_from(const Graph *graph, guint end) {
  const SbPiece piece = g_array_index(graph->edges, Drawn, end / 2).piece;
  return end % 2 == 0 ? piece : (SbPiece){piece.x1, piece.y1, piece.x0, piece.y0, -piece.bulge};
}

// Joins the ends at one point, and each end off the axis that is then alone to the nearest one
// within `gap`. Appends those that remain alone to `alone` (points).
static void join_ends(Graph *graph, double gap, GArray *alone) {
  const guint count = 2 * graph->drawn;
  for (guint pass = 0; pass < 2 * count; pass++) {
    const bool first = pass < count;
    const guint end = pass % count;
    const SbPiece piece = piece_from(graph, end);
    const bool itself = sb_piece_length(&piece) > 2 * gap; // the gap of an arc
    double nearest = first ? TINY * TINY : gap * gap;
    guint best = count;
    if (!first && (piece.y0 == 0 || graph->ends[graph->node[end]] > 1)) {
      continue;
    }
    for (guint k = 0; k < (first ? end : count); k++) {
      const SbPiece other = piece_from(graph, k);
      const double dx = other.x0 - piece.x0, dy = other.y0 - piece.y0, off = dx * dx + dy * dy;
      if (off <= nearest && k != end && (itself || k / 2 != end / 2)) {
        nearest = off;
        best = k;
      }
    }
    if (best < count || first) {
      graph->node[end] = best < count ? graph->node[best] : end;
      graph->ends[graph->node[end]]++;
    } else {
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
    const guint node = graph->node[end], own = part[end] = part[node];
    open[own] = open[own] || (piece_from(graph, end).y0 == 0 && graph->ends[node] % 2 == 1);
    g_array_index(graph->edges, Drawn, end / 2).part = own;
  }
  for (guint end = 0; end < count; end++) {
    const SbPiece from = piece_from(graph, end);
    const bool begins = from.y0 == 0 && graph->node[end] == end && open[part[end]];
    guint best = count;
    double x = INFINITY; // of the next end to the right
    for (guint k = 0; begins && k < count; k++) {
      const SbPiece to = piece_from(graph, k);
      if (to.y0 == 0 && part[k] == part[end] && to.x0 > from.x0 + TINY && to.x0 < x) {
        best = k;
        x = to.x0;
      }
    }
    if (best < count) {
      const Drawn axis = drawn_of((SbPiece){from.x0, 0, x, 0, 0});
      g_array_append_val(graph->edges, axis);
      graph->node[2 * graph->edges->len - 2] = end;
      graph->node[2 * graph->edges->len - 1] = graph->node[best];
    }
  }
}

// An end, its point, and its direction at a small distance, where tangent edges differ.
typedef struct {
  guint end, node;
  double angle;
} Direction;

static gint compare_directions(gconstpointer a, gconstpointer b) {
  const Direction *p = a, *q = b;
  return p->node != q->node ? (p->node > q->node) - (p->node < q->node)
                            : (p->angle > q->angle) - (p->angle < q->angle);
}

// Orders the ends at each point counter-clockwise. The boundary of a face, on its right, then goes
// on from the edge left from `end` with that left from next[end ^ 1].
static void turn_ends(const Graph *graph) {
  const guint count = 2 * graph->edges->len;
  g_autofree Direction *all = g_new0(Direction, count + 1);
  g_autofree double *near = g_new0(double, count + 1); // of a node: 1 / least reach of its edges
  for (guint end = 0; end < count; end++) {
    double *least = &near[graph->node[end]];
    *least = fmax(*least, 1 / g_array_index(graph->edges, Drawn, end / 2).reach);
  }
  for (guint end = 0; end < count; end++) {
    const SbPiece piece = piece_from(graph, end);
    const guint node = graph->node[end];
    double at[2];
    sb_piece_point(&piece, 1 / near[node] / sb_piece_length(&piece), at);
    all[end] = (Direction){end, node, atan2(at[1] - piece.y0, at[0] - piece.x0)};
  }
  qsort(all, count, sizeof *all, compare_directions);
  for (guint i = 0, first = 0; i < count; i++) {
    const bool last = all[i + 1].node != all[i].node || i + 1 == count;
    graph->next[all[i].end] = all[last ? first : i + 1].end;
    first = last ? i + 1 : first;
  }
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
  g_autoptr(GArray) chain = g_array_new(FALSE, FALSE, sizeof(SbPiece));
  double area = 0, length = 0;
  for (guint i = 0; i < count; i++) {
    const guint end = cycle[(first + i) % count];
    const SbPiece piece = piece_from(graph, end);
    if (end / 2 < graph->drawn) {
      area += sb_piece_area(&piece, piece_from(graph, cycle[0]).x0);
      length += sb_piece_length(&piece);
      g_array_append_val(chain, piece);
    }
  }
  if (fabs(area) > gap * length) {
    const guint part = g_array_index(graph->edges, Drawn, cycle[first % count] / 2).part;
    const SbCadOutline outline = {g_steal_pointer(&chain), closed, part, false};
    g_ptr_array_add(outlines, g_memdup2(&outline, sizeof outline));
  }
}

// Appends the outer boundary of the faces of the graph of `edges` (of Drawn, changed) to `outlines`
// and ends that meet no other to `alone`. Returns the edges between two faces.
static GArray *add_boundary(GPtrArray *outlines, GArray *alone, GArray *edges, double gap) {
  const gsize most = 6 * (gsize)edges->len + 1; // ends, with those of edges on the axis
  g_autofree guint *node = g_new0(guint, most), *next = g_new0(guint, most);
  g_autofree guint *face = g_new0(guint, most), *place = g_new0(guint, most);
  g_autofree guint *ends = g_new0(guint, most);
  g_autoptr(GArray) outer = g_array_new(FALSE, TRUE, sizeof(bool));
  g_autoptr(GArray) cycle = g_array_new(FALSE, FALSE, sizeof(guint));
  Graph graph = {edges, edges->len, node, next, ends};
  join_ends(&graph, gap, alone);
  close_by_axis(&graph);
  turn_ends(&graph);
  g_array_set_size(outer, 1);
  for (guint begin = 0; begin < 2 * edges->len; begin++) {
    const guint own = outer->len;
    double area = 0;
    for (guint end = begin; face[end] == 0; end = next[end ^ 1U]) {
      const SbPiece piece = piece_from(&graph, end);
      face[end] = own;
      area += sb_piece_area(&piece, piece_from(&graph, begin).x0);
    }
    if (face[begin] != own) {
      continue;
    }
    // The outer face is on the right of its counter-clockwise boundary, which may pass a point
    // twice.
    const bool is_outer = area > 0;
    g_array_append_val(outer, is_outer);
    guint end = begin;
    for (bool more = is_outer; more; more = end != begin) {
      g_array_append_val(cycle, end);
      place[node[end]] = cycle->len;
      const guint at = place[node[end ^ 1U]];
      end = next[end ^ 1U];
      if (at > 0) {
        const guint *loop = &g_array_index(cycle, guint, at - 1);
        add_outline(outlines, &graph, loop, cycle->len - at + 1, gap);
        for (guint k = at - 1; k < cycle->len; k++) {
          place[node[g_array_index(cycle, guint, k)]] = 0;
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

void sb_cad_add_closed(SbCadLines *half, const GArray *pieces, double gap, double same) {
  g_autoptr(GArray) edges = tidied(pieces, same, true);
  half->crossed = edges->len;
  for (guint count = 0; count != edges->len;) {
    count = edges->len;
    GArray *inner = add_boundary(half->outlines, half->alone, edges, gap);
    g_array_unref(edges);
    edges = inner;
  }
  half->crossed *= half->outlines->len + half->alone->len == 0;
}

void sb_cad_add_open(SbCadLines *half, const GArray *pieces, double gap, double same) {
  g_autoptr(GArray) edges = tidied(pieces, same, false);
  const guint before = half->outlines->len;
  for (guint i = 0; i < edges->len; i++) {
    half->doubled += g_array_index(edges, Drawn, i).times - 1;
  }
  g_autoptr(GArray) inner = add_boundary(half->outlines, half->alone, edges, gap);
  for (guint i = 0; i < inner->len; i++) {
    const Drawn *edge = &g_array_index(inner, Drawn, i);
    const SbPiece *piece = &edge->piece;
    const bool sure = edge->times > 1 || (edge->inside[0] && edge->inside[1]) ||
                      (piece->bulge == 0 && fabs(piece->x1 - piece->x0) <= same);
    half->doubled -= edge->times - 1;
    half->inner += sure && edge->times == 1;
    for (guint k = before; !sure && k < half->outlines->len; k++) {
      SbCadOutline *outline = half->outlines->pdata[k];
      outline->unsure = outline->unsure || outline->part == edge->part;
    }
  }
}
