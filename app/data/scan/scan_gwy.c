// Gwyddion's container: GWYP, then an object: its name, the bytes that it takes, its components,
// each a name, a letter for the kind and the value. Numbers are little-endian. Taken are
// "/N/data" (GwyDataField: xres, yres, xreal, yreal, si_unit_xy, si_unit_z, data), "/N/data/title"
// and "/N/mask", whose points of 0.5 and more are missing; everything else is stepped over.
#include "app/data/scan/scan_private.h"

#include <math.h>
#include <stdlib.h>

enum { CHANNELS_MAX = 1024 };

typedef struct {
  const char *name;
  char kind;
  const guchar *value; // begins here; of an array behind its count
  guint64 count;       // of an array, or bytes of an object behind its head
  const char *object;  // its class
} Component;

static gboolean cut_short(const SbScanBytes *bytes, GError **error) {
  return sb_scan_fail(error, bytes->name, "is cut short, or no container of Gwyddion's");
}

// A text with its end within the bytes; NULL without.
static const char *take_text(SbScanBytes *bytes) {
  const guchar *end =
      bytes->at < bytes->end ? memchr(bytes->at, '\0', (gsize)(bytes->end - bytes->at)) : NULL;
  const char *text = (const char *)bytes->at;
  if (end == NULL) {
    return NULL;
  }
  bytes->at = end + 1;
  return text;
}

static gboolean take_bytes(SbScanBytes *bytes, guint64 count) {
  if (count > (guint64)(bytes->end - bytes->at)) {
    return FALSE;
  }
  bytes->at += count;
  return TRUE;
}

static gboolean take_count(SbScanBytes *bytes, guint64 *out) {
  const guchar *p = bytes->at;
  if (!take_bytes(bytes, 4)) {
    return FALSE;
  }
  *out = sb_scan_u32(p);
  return TRUE;
}

// Class and bytes of an object.
static gboolean take_object(SbScanBytes *bytes, const char **name, guint64 *size) {
  *name = take_text(bytes);
  return *name != NULL && take_count(bytes, size) && *size <= (guint64)(bytes->end - bytes->at);
}

static guint64 size_of(char kind) {
  switch (g_ascii_tolower(kind)) {
  case 'b':
  case 'c':
    return 1;
  case 'i':
    return 4;
  case 'q':
  case 'd':
    return 8;
  default:
    return 0;
  }
}

// The next component of an object's bytes.
static gboolean take_component(Component *out, SbScanBytes *bytes) {
  *out = (Component){.name = take_text(bytes)};
  if (out->name == NULL || bytes->at >= bytes->end) {
    return FALSE;
  }
  out->kind = (char)*bytes->at++;
  const gboolean array = g_ascii_isupper(out->kind);
  const guint64 size = size_of(out->kind);
  if (array && !take_count(bytes, &out->count)) {
    return FALSE;
  }
  out->value = bytes->at;
  if (size > 0) {
    return take_bytes(bytes, size * (array ? out->count : 1));
  }
  for (guint64 k = 0; k < (array ? out->count : 1); k++) {
    guint64 inside = 0;
    const char *name = NULL;
    if (g_ascii_tolower(out->kind) == 's') {
      name = take_text(bytes);
    } else if (g_ascii_tolower(out->kind) == 'o' && take_object(bytes, &name, &inside)) {
      if (!array) {
        out->object = name;
        out->value = bytes->at;
        out->count = inside;
      }
      name = take_bytes(bytes, inside) ? name : NULL;
    }
    if (name == NULL) {
      return FALSE;
    }
  }
  return TRUE;
}

static SbScanBytes inside_of(const Component *component, const char *name) {
  return (SbScanBytes){component->value, component->value + component->count, name};
}

// ---- Fields ----

typedef struct {
  gint64 columns, rows;
  double width, height;
  char *unit_xy, *unit_z; // owned
  const guchar *data;
  guint64 count;
} Field;

static void field_clear(Field *field) {
  g_free(field->unit_xy);
  g_free(field->unit_z);
}

// The text of a GwySIUnit; empty without.
static char *unit_text(const Component *unit, const char *name) {
  SbScanBytes inside = inside_of(unit, name);
  Component each;
  while (inside.at < inside.end && take_component(&each, &inside)) {
    if (each.kind == 's' && strcmp(each.name, "unitstr") == 0) {
      return g_strdup((const char *)each.value);
    }
  }
  return g_strdup("");
}

static gboolean read_field(Field *out, const Component *component, const char *name,
                           GError **error) {
  SbScanBytes inside = inside_of(component, name);
  Component each;
  *out = (Field){0};
  while (inside.at < inside.end) {
    if (!take_component(&each, &inside)) {
      field_clear(out);
      return cut_short(&inside, error);
    }
    if (each.kind == 'i' && strcmp(each.name, "xres") == 0) {
      out->columns = (gint32)sb_scan_u32(each.value);
    } else if (each.kind == 'i' && strcmp(each.name, "yres") == 0) {
      out->rows = (gint32)sb_scan_u32(each.value);
    } else if (each.kind == 'd' && strcmp(each.name, "xreal") == 0) {
      out->width = sb_scan_double(each.value);
    } else if (each.kind == 'd' && strcmp(each.name, "yreal") == 0) {
      out->height = sb_scan_double(each.value);
    } else if (each.kind == 'D' && strcmp(each.name, "data") == 0) {
      out->data = each.value;
      out->count = each.count;
    } else if (each.kind == 'o' && strcmp(each.name, "si_unit_xy") == 0) {
      g_free(out->unit_xy);
      out->unit_xy = unit_text(&each, name);
    } else if (each.kind == 'o' && strcmp(each.name, "si_unit_z") == 0) {
      g_free(out->unit_z);
      out->unit_z = unit_text(&each, name);
    }
  }
  if (out->columns < 1 || out->rows < 1 || out->data == NULL ||
      (guint64)out->columns > out->count ||
      out->count / (guint64)out->columns != (guint64)out->rows ||
      out->count % (guint64)out->columns != 0) {
    field_clear(out);
    return sb_scan_fail(error, name, "a data field's size is not that of its data");
  }
  return TRUE;
}

// ---- Channels ----

typedef struct {
  long id;
  Component data, mask;
  const char *title;
} Channel;

static Channel *channel_of(GArray *channels, long id) {
  for (guint i = 0; i < channels->len; i++) {
    if (g_array_index(channels, Channel, i).id == id) {
      return &g_array_index(channels, Channel, i);
    }
  }
  if (channels->len == CHANNELS_MAX) {
    return NULL;
  }
  g_array_append_val(channels, ((Channel){.id = id}));
  return &g_array_index(channels, Channel, channels->len - 1);
}

// "/3/data", "/3/data/title", "/3/mask".
static void take_channel(GArray *channels, const Component *each) {
  if (each->name[0] != '/' || !g_ascii_isdigit(each->name[1])) {
    return;
  }
  char *rest = NULL;
  const long id = strtol(each->name + 1, &rest, 10);
  const gboolean field = each->object != NULL && strcmp(each->object, "GwyDataField") == 0;
  const gboolean data = field && strcmp(rest, "/data") == 0;
  const gboolean mask = field && strcmp(rest, "/mask") == 0;
  const gboolean title = each->kind == 's' && strcmp(rest, "/data/title") == 0;
  Channel *channel = data || mask || title ? channel_of(channels, id) : NULL;
  if (channel != NULL && data) {
    channel->data = *each;
  } else if (channel != NULL && mask) {
    channel->mask = *each;
  } else if (channel != NULL) {
    channel->title = (const char *)each->value;
  }
}

static gboolean is_height(const Channel *channel, const char *name) {
  Field field;
  if (channel->data.value == NULL || !read_field(&field, &channel->data, name, NULL)) {
    return FALSE;
  }
  const gboolean height = g_strcmp0(field.unit_z, "m") == 0;
  field_clear(&field);
  return height;
}

// The one that is asked for, else the only one of heights.
static const Channel *choose(const GArray *channels, const char *wanted, const char *name,
                             GError **error) {
  const Channel *found = NULL;
  int count = 0;
  g_autoptr(GString) list = g_string_new(NULL);
  for (guint i = 0; i < channels->len; i++) {
    const Channel *channel = &g_array_index(channels, Channel, i);
    g_autofree char *number = g_strdup_printf("%ld", channel->id);
    if (channel->data.value == NULL) {
      continue;
    }
    if (wanted != NULL ? strcmp(number, wanted) == 0 || g_strcmp0(channel->title, wanted) == 0
                       : is_height(channel, name)) {
      count++;
      found = channel;
    }
    if (list->len < 200) {
      g_string_append_printf(list, "%s%s%s%s%s", list->len > 0 ? ", " : "", number,
                             channel->title != NULL ? " \"" : "",
                             channel->title != NULL ? channel->title : "",
                             channel->title != NULL ? "\"" : "");
    }
  }
  if (count == 1) {
    return found;
  }
  if (count > 1) {
    sb_scan_fail(error, name, "has %d channels%s: choose one with --channel (%s)", count,
                 wanted != NULL ? " of that title" : " of heights", list->str);
  } else if (list->len == 0) {
    sb_scan_fail(error, name, "has no data field");
  } else {
    sb_scan_fail(error, name, "has no channel %s (there are %s)",
                 wanted != NULL ? wanted : "of heights", list->str);
  }
  return NULL;
}

static gboolean apply_mask(SbScan *out, const Channel *channel, const char *name, GError **error) {
  Field mask;
  if (!read_field(&mask, &channel->mask, name, error)) {
    return FALSE;
  }
  const gboolean same = mask.count == (guint64)out->heights.columns * out->heights.rows &&
                        (gsize)mask.columns == out->heights.columns;
  guint64 masked = 0;
  for (guint64 i = 0; same && i < mask.count; i++) {
    if (sb_scan_double(mask.data + 8 * i) >= 0.5) {
      out->heights.z[i] = NAN;
      masked++;
    }
  }
  field_clear(&mask);
  if (!same) {
    return sb_scan_fail(error, name, "the mask has not the size of its data");
  }
  if (masked > 0) {
    g_ptr_array_add(out->notes,
                    g_strdup_printf("%" G_GUINT64_FORMAT
                                    " masked points are treated as missing (--ignore-mask)",
                                    masked));
  }
  return TRUE;
}

static gboolean read_channel(SbScan *out, const Channel *channel, const SbScanChoices *choices,
                             const char *name, GError **error) {
  Field field;
  if (!read_field(&field, &channel->data, name, error)) {
    return FALSE;
  }
  const double xy = sb_scan_length(field.unit_xy != NULL ? field.unit_xy : "");
  const double z = sb_scan_length(field.unit_z != NULL ? field.unit_z : "");
  gboolean good = xy > 0 && z > 0;
  if (!good) {
    sb_scan_fail(error, name, "units of the channel are not lengths (\"%s\", heights \"%s\")",
                 field.unit_xy != NULL ? field.unit_xy : "",
                 field.unit_z != NULL ? field.unit_z : "");
  }
  good = good && sb_scan_allocate(out, (guint64)field.columns, (guint64)field.rows, name, error);
  for (guint64 i = 0; good && i < field.count; i++) {
    out->heights.z[i] = z * sb_scan_double(field.data + 8 * i);
  }
  out->heights.dx = xy * field.width / (double)field.columns;
  out->heights.dy = xy * field.height / (double)field.rows;
  out->title = g_strdup(channel->title);
  field_clear(&field);
  return good && (channel->mask.value == NULL || choices->ignore_mask ||
                  apply_mask(out, channel, name, error));
}

gboolean sb_scan_parse_gwy(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                           GError **error) {
  out->format = "Gwyddion";
  bytes.at += 4;
  const char *class = NULL;
  guint64 size = 0;
  if (!take_object(&bytes, &class, &size)) {
    return cut_short(&bytes, error);
  }
  if (strcmp(class, "GwyContainer") != 0) {
    return sb_scan_fail(error, bytes.name, "contains no GwyContainer");
  }
  bytes.end = bytes.at + size;
  g_autoptr(GArray) channels = g_array_new(FALSE, FALSE, sizeof(Channel));
  while (bytes.at < bytes.end) {
    Component each;
    if (!take_component(&each, &bytes)) {
      return cut_short(&bytes, error);
    }
    take_channel(channels, &each);
  }
  const Channel *channel = choose(channels, choices->channel, bytes.name, error);
  return channel != NULL && read_channel(out, channel, choices, bytes.name, error);
}
