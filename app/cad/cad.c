// See cad.h.
#include "app/cad/cad_private.h"

SbCadBody *sb_cad_body_new(const char *name) {
  SbCadBody *body = g_new0(SbCadBody, 1);
  body->name = g_strdup(name);
  body->profile = g_array_new(FALSE, FALSE, sizeof(SbProfilePoint));
  body->features = g_array_new(FALSE, FALSE, sizeof(SbCadFeature));
  return body;
}

static void body_free(gpointer data) {
  SbCadBody *body = data;
  g_array_unref(body->profile);
  g_array_unref(body->features);
  g_free(body->name);
  g_free(body->why);
  g_free(body);
}

char *sb_cad_axis_text(const double *through, const double *direction) {
  char text[6][SB_NUMBER_SIZE];
  const double length = hypot(hypot(direction[0], direction[1]), direction[2]);
  for (int i = 0; i < 6; i++) {
    const double value = i >= 3            ? direction[i - 3] / length
                         : through != NULL ? 1e3 * through[i]
                                           : 0;
    sb_number_round(text[i], fabs(value) < 1e-9 ? 0 : value, 6);
  }
  g_autofree char *at = g_strdup_printf("through %s, %s, %s mm ", text[0], text[1], text[2]);
  return g_strdup_printf("%salong %s, %s, %s", through ? at : "", text[3], text[4], text[5]);
}

static SbProfile profile_of(const SbCadBody *body) {
  return (SbProfile){(void *)body->profile->data, body->profile->len, body->closed};
}

SbCad *sb_cad_new(const char *format) {
  SbCad *cad = g_new0(SbCad, 1);
  cad->format = format;
  cad->bodies = g_ptr_array_new_with_free_func(body_free);
  cad->warnings = g_ptr_array_new_with_free_func(g_free);
  return cad;
}

void sb_cad_free(SbCad *cad) {
  if (cad == NULL) {
    return;
  }
  g_ptr_array_unref(cad->bodies);
  g_ptr_array_unref(cad->warnings);
  g_free(cad->unit);
  g_free(cad->axis);
  g_free(cad);
}

// Two radii that are one [m]; and the shortest cylinder that counts for more than a rounded corner.
static const double EQUAL = 1e-7, SHORTEST = 50e-6;

static bool is_level(const SbPiece *p) {
  return p->bulge == 0 && fabs(p->y1 - p->y0) <= EQUAL && fabs(p->x1 - p->x0) > EQUAL;
}

// The wall beside an outer cylinder: follows the outline from piece `from` by `step` while it
// rises. The straight radial piece of most height gives its place, else the middle of the rise.
static double wall(double *height, const SbPiece *pieces, int count, int from, int step) {
  const SbPiece *floor = &pieces[from];
  const double radius = floor->y0, start = step > 0 ? floor->x1 : floor->x0;
  double at = NAN, tallest = 0, end = start;
  *height = 0;
  for (int n = 1; n < count; n++) {
    const SbPiece *piece = &pieces[((from + step * n) % count + count) % count];
    const double r0 = step > 0 ? piece->y0 : piece->y1, r1 = step > 0 ? piece->y1 : piece->y0;
    if (r1 < r0 - EQUAL || (is_level(piece) && fabs(piece->x1 - piece->x0) > SHORTEST)) {
      break;
    }
    if (piece->bulge == 0 && fabs(piece->x1 - piece->x0) <= EQUAL && r1 - r0 > tallest) {
      tallest = r1 - r0;
      at = piece->x0;
    }
    end = step > 0 ? piece->x1 : piece->x0;
    *height = r1 - radius;
  }
  return isnan(at) ? (start + end) / 2 : at;
}

// Appends lands, bores and grooves of a counter-clockwise profile.
static void add_features(SbCadBody *body) {
  const SbProfile profile = profile_of(body);
  const int count = (int)profile.count - !profile.closed;
  g_autofree SbPiece *pieces = g_new(SbPiece, MAX(count, 1));
  for (int i = 0; i < count; i++) {
    pieces[i] = sb_profile_piece(&profile, (size_t)i);
  }
  for (int i = 0; i < count; i++) {
    const SbPiece *piece = &pieces[i];
    const double length = fabs(piece->x1 - piece->x0);
    if (!is_level(piece) || piece->y0 <= EQUAL || length < SHORTEST) {
      continue;
    }
    // Counter-clockwise: material is on the left, so an outer surface runs towards -x.
    const bool outer = piece->x1 < piece->x0;
    SbCadFeature feature = {fmin(piece->x0, piece->x1), fmax(piece->x0, piece->x1), 2 * piece->y0,
                            0, outer ? SB_CAD_LAND : SB_CAD_BORE};
    if (outer) {
      double left, right;
      const double x0 = wall(&left, pieces, count, i, 1);
      const double x1 = wall(&right, pieces, count, i, -1);
      if (fmin(left, right) > SHORTEST) {
        feature = (SbCadFeature){x0, x1, 2 * piece->y0, fmin(left, right), SB_CAD_GROOVE};
      }
    }
    g_array_append_val(body->features, feature);
  }
  g_array_sort(body->features, sb_number_compare); // by x0
}

static void settle_body(SbCadBody *body, const SbCadChoices *choices) {
  const double sign = choices->flip ? -1 : 1;
  for (guint i = 0; i < body->profile->len; i++) {
    SbProfilePoint *p = &g_array_index(body->profile, SbProfilePoint, i);
    // Nothing below a hundredth of a nanometre: what moving and cutting leaves.
    p->x = round(1e11 * (sign * p->x + choices->shift)) / 1e11;
    p->r = round(1e11 * p->r) / 1e11;
    p->bulge *= sign;
  }
  body->solid.centre[0] = sign * body->solid.centre[0] + choices->shift;
  if (body->profile->len == 0) {
    return;
  }
  sb_profile_turn(body->profile, body->closed);
  const SbProfile profile = profile_of(body);
  SbReport report = {0};
  if (sb_solid_revolve(&body->revolved, &profile, 1, &report) != SB_OK) {
    body->why = g_strdup(report.text);
    g_array_set_size(body->profile, 0);
    return;
  }
  body->solid = body->measured ? body->solid : body->revolved;
  add_features(body);
}

// Makes a body within an odd number of others of its layer a cavity of the smallest one.
static void join_outline_cavities(SbCad *cad) {
  g_autofree SbCadBody **around = g_new0(SbCadBody *, cad->bodies->len + 1);
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *inner = cad->bodies->pdata[i];
    const SbProfile within = profile_of(inner);
    guint depth = 0;
    for (guint k = 0; k < cad->bodies->len; k++) {
      SbCadBody *body = cad->bodies->pdata[k];
      const SbProfile outline = profile_of(body);
      if (k != i && body->layer == inner->layer && !body->measured && within.count > 0 &&
          outline.count > 0 && body->revolved.volume > inner->revolved.volume &&
          sb_profile_encloses(&outline, &within)) {
        const bool nearer = depth++ == 0 || body->revolved.volume < around[i]->revolved.volume;
        around[i] = nearer ? body : around[i];
      }
    }
    around[i] = depth % 2 == 1 ? around[i] : NULL;
  }
  for (guint i = cad->bodies->len; i-- > 0;) {
    const SbCadBody *inner = cad->bodies->pdata[i];
    if (around[i] != NULL && g_ptr_array_find(cad->bodies, around[i], NULL) &&
        around[i]->solid.volume > inner->solid.volume) {
      sb_solid_remove(&around[i]->solid, &inner->solid);
      around[i]->measured = true;
      sb_note_add(cad->warnings, "%s: the outline within it is a cavity", around[i]->name);
      g_ptr_array_remove_index(cad->bodies, i);
    }
  }
}

// Relative differences of moments and volumes from a body of revolution that cause a warning.
static const double ROUND = 0.02;

void sb_cad_settle(SbCad *cad, const SbCadChoices *choices) {
  for (guint i = 0; i < cad->bodies->len; i++) {
    SbCadBody *body = cad->bodies->pdata[i];
    settle_body(body, choices);
    double(*const moment)[3] = body->solid.inertia;
    const double apart = hypot(moment[1][1] - moment[2][2], 2 * moment[1][2]);
    const double uneven = apart / (moment[1][1] + moment[2][2]);
    const double volume = body->solid.volume, more = body->revolved.volume / volume - 1;
    const double least = fmin(fabs(more), fabs(more - body->hollow / volume)); // ports, or a cavity
    const bool turns = body->profile->len == 0 || least <= ROUND;
    if (body->measured && (uneven > ROUND || !turns)) {
      sb_note_add(cad->warnings, "%s: not a body of revolution about the axis: %s by %.3g %%",
                  body->name,
                  turns ? "its moments across it differ" : "its half-section, revolved, is off",
                  100 * (turns ? uneven : fabs(more)));
    }
  }
  join_outline_cavities(cad);
}

SbCad *sb_cad_read(const char *path, const SbCadChoices *choices, GError **error) {
  const size_t most = (size_t)256 << 20;
  size_t size;
  g_autofree char *text = sb_reader_load_file(&size, path, path, most, SB_APP_ERROR_INPUT, error);
  if (text == NULL) {
    return NULL;
  }
  // The content decides; the name only where the content is of no known kind.
  g_autofree char *lower = g_ascii_strdown(path, -1);
  return g_strstr_len(text, (gssize)MIN(size, 1000), "ISO-10303-21") != NULL
             ? sb_cad_read_step(path, choices, error)
         : sb_cad_is_stl(text, size) || g_str_has_suffix(lower, ".stl")
             ? sb_cad_parse_stl(text, size, path, choices, error)
             : sb_cad_parse_dxf(text, size, path, choices, error);
}

static bool read_point(SbProfilePoint *out, const char *word, double scale) {
  g_auto(GStrv) numbers = g_strsplit(word, ",", -1);
  const guint parts = g_strv_length(numbers);
  double value[3] = {0};
  bool good = parts == 2 || parts == 3;
  for (guint k = 0; good && k < parts; k++) {
    good = sb_number_parse(&value[k], numbers[k]);
  }
  *out = (SbProfilePoint){scale * value[0], scale * value[1], value[2]};
  return good;
}

GArray *sb_profile_parse(const char *text, bool *closed, GError **error) {
  g_auto(GStrv) words = g_strsplit_set(text, " \t\r\n", -1);
  g_autoptr(GArray) points = g_array_new(FALSE, FALSE, sizeof(SbProfilePoint));
  double scale = 0;
  bool good = true;
  for (char **word = words; good && *word != NULL; word++) {
    SbProfilePoint point;
    if (**word == '\0') {
      continue;
    }
    if (scale == 0) {
      good = sb_unit_scale(&scale, *word, "m", "mm", NULL) ||
             sb_app_error_input(error, "starts with the unit of its points, not '%s'", *word);
    } else if (points->len == SB_PROFILE_MAX) {
      good = sb_app_error_input(error, "has more than %d points", SB_PROFILE_MAX);
    } else if (!read_point(&point, *word, scale)) {
      good = sb_app_error_input(error, "point %u is not x,r or x,r,bulge", points->len + 1);
    } else {
      g_array_append_val(points, point);
    }
  }
  const SbProfilePoint *point = (const SbProfilePoint *)(void *)points->data;
  const guint count = points->len;
  *closed = count > 1 && point[0].x == point[count - 1].x && point[0].r == point[count - 1].r;
  g_array_set_size(points, count - (*closed ? 1 : 0));
  good = good && (points->len >= 2 ||
                  sb_app_error_input(error, "has %u points, not two or more", points->len));
  return good ? g_steal_pointer(&points) : NULL;
}

void sb_profile_turn(GArray *points, bool closed) {
  const SbProfile profile = {(void *)points->data, points->len, closed};
  const guint n = points->len > 1 && sb_profile_area(&profile) < 0 ? points->len : 0;
  g_autofree SbProfilePoint *old = g_memdup2(points->data, n * sizeof *old);
  for (guint i = 0; i < n; i++) {
    SbProfilePoint *p = &g_array_index(points, SbProfilePoint, i);
    *p = old[n - 1 - i];
    p->bulge = i + 1 < n ? -old[n - 2 - i].bulge : closed ? -old[n - 1].bulge : 0;
  }
}

char *sb_cad_profile_text(const SbCadBody *body) {
  if (body->profile->len == 0) {
    return NULL;
  }
  GString *text = g_string_new("mm");
  const guint points = body->profile->len;
  for (guint i = 0; i < points + body->closed; i++) {
    const SbProfilePoint *p = &g_array_index(body->profile, SbProfilePoint, i % points);
    char x[SB_NUMBER_SIZE], r[SB_NUMBER_SIZE];
    g_string_append_printf(text, " %s,%s", sb_number_round(x, 1e3 * p->x, 12),
                           sb_number_round(r, 1e3 * p->r, 12));
    if (p->bulge != 0 && i < points) {
      g_string_append_printf(text, ",%s", sb_number_round(x, p->bulge, 12));
    }
  }
  return g_string_free(text, FALSE);
}
