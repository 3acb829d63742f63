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
  guint64 count;       // of an array, or bytes of an object behind its head; 0: absent
  const char *object;  // its class
} Component;

// Steps over `count` bytes and returns them; NULL if there are fewer.
static const guchar *take(SbScanBytes *bytes, guint64 count) {
  const guchar *at = bytes->at;
  if (count > (guint64)(bytes->end - at)) {
    return NULL;
  }
  bytes->at += count;
  return at;
}

// A text with its end within the bytes; NULL without.
static const char *take_text(SbScanBytes *bytes) {
  const guint64 left = (guint64)(bytes->end - bytes->at);
  const guint64 length = strnlen((const char *)bytes->at, left);
  return length < left ? (const char *)take(bytes, length + 1) : NULL;
}

static bool take_count(SbScanBytes *bytes, guint64 *out) {
  const guchar *p = take(bytes, 4);
  *out = p != NULL ? sb_bytes_u32(p) : 0;
  return p != NULL;
}

// Returns the class of an object and writes its content; NULL if it is not complete.
static const char *take_object(SbScanBytes *bytes, SbScanBytes *content) {
  const char *name = take_text(bytes);
  guint64 size;
  if (name == NULL || !take_count(bytes, &size)) {
    return NULL;
  }
  content->at = take(bytes, size);
  content->end = bytes->at;
  return content->at != NULL ? name : NULL;
}

// The next component of an object's bytes.
static bool take_component(Component *out, SbScanBytes *bytes) {
  static const char numbers[] = "bciqd";
  static const guint8 sizes[] = {1, 1, 4, 8, 8};
  *out = (Component){.name = take_text(bytes)};
  const guchar *kind = out->name != NULL ? take(bytes, 1) : NULL;
  if (kind == NULL) {
    return false;
  }
  out->kind = (char)*kind;
  const char one = g_ascii_tolower(out->kind), *number = memchr(numbers, one, sizeof sizes);
  guint64 count = 1;
  if (one != out->kind && !take_count(bytes, &count)) {
    return false;
  }
  out->value = bytes->at;
  out->count = count;
  if (number != NULL) {
    return take(bytes, sizes[number - numbers] * count) != NULL;
  }
  const char *text = "";
  for (guint64 k = 0; k < count && text != NULL; k++) {
    SbScanBytes content = *bytes;
    text = one == 's' ? take_text(bytes) : one == 'o' ? take_object(bytes, &content) : NULL;
    if (out->kind == 'o' && text != NULL) {
      out->object = text;
      out->value = content.at;
      out->count = (guint64)(content.end - content.at);
    }
  }
  return text != NULL;
}

// Finds a component of an object. Returns false, with out->value NULL, if there is none.
static bool find(Component *out, const Component *object, char kind, const char *name) {
  SbScanBytes inside = {object->value, object->value + object->count};
  while (take_component(out, &inside)) {
    if (out->kind == kind && strcmp(out->name, name) == 0) {
      return true;
    }
  }
  out->value = NULL;
  return false;
}

// ---- Fields ----

typedef struct {
  guint64 columns, rows;
  double width, height;
  const char *unit_xy, *unit_z;
  const guchar *data; // of doubles
} Field;

// The text of a GwySIUnit; empty without.
static const char *unit_of(const Component *field, const char *name) {
  Component unit, text;
  const bool known = find(&unit, field, 'o', name) && find(&text, &unit, 's', "unitstr");
  return known ? (const char *)text.value : "";
}

static bool read_field(Field *out, const Component *field, GError **error) {
  Component columns, rows, width, height, data;
  const bool sized = find(&columns, field, 'i', "xres") && find(&rows, field, 'i', "yres");
  *out = (Field){.unit_xy = unit_of(field, "si_unit_xy"), .unit_z = unit_of(field, "si_unit_z")};
  out->columns = sized ? sb_bytes_u32(columns.value) : 0;
  out->rows = sized ? sb_bytes_u32(rows.value) : 0;
  out->width = find(&width, field, 'd', "xreal") ? sb_bytes_double(width.value) : 0;
  out->height = find(&height, field, 'd', "yreal") ? sb_bytes_double(height.value) : 0;
  if (!find(&data, field, 'D', "data") || data.count == 0 ||
      out->columns * out->rows != data.count) {
    return sb_app_error_input(error, "a data field's size is not that of its data");
  }
  out->data = data.value;
  return true;
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
  const bool field = g_strcmp0(each->object, "GwyDataField") == 0;
  const bool data = field && strcmp(rest, "/data") == 0, mask = field && strcmp(rest, "/mask") == 0;
  const bool title = each->kind == 's' && strcmp(rest, "/data/title") == 0;
  Channel *channel = data || mask || title ? channel_of(channels, id) : NULL;
  if (channel != NULL && title) {
    channel->title = (const char *)each->value;
  } else if (channel != NULL) {
    *(data ? &channel->data : &channel->mask) = *each;
  }
}

// The one that is requested, else the only one of heights.
static const Channel *choose(const GArray *channels, const char *wanted, GError **error) {
  const Channel *found = NULL;
  int count = 0;
  Field field;
  g_autoptr(GString) list = g_string_new(NULL), fitting = g_string_new(NULL);
  for (guint i = 0; i < channels->len; i++) {
    const Channel *channel = &g_array_index(channels, Channel, i);
    g_autofree char *number = g_strdup_printf("%ld", channel->id);
    if (channel->data.value == NULL) {
      continue;
    }
    if (wanted != NULL
            ? strcmp(number, wanted) == 0 || g_strcmp0(channel->title, wanted) == 0
            : read_field(&field, &channel->data, NULL) && strcmp(field.unit_z, "m") == 0) {
      g_string_append_printf(fitting, "%s%s", count++ > 0 ? "\n" : "", number);
      found = channel;
    }
    if (list->len < 200) {
      g_string_append_printf(list, "%s%s", list->len > 0 ? ", " : "", number);
      g_string_append_printf(list, channel->title != NULL ? " \"%s\"" : "%s",
                             channel->title != NULL ? channel->title : "");
    }
  }
  if (count > 1) {
    sb_app_error_choose(error, "channel", fitting->str, "has %d channels%s (%s)", count,
                        wanted != NULL ? " of that title" : " of heights", list->str);
  } else if (count == 0 && list->len == 0) {
    sb_app_error_input(error, "has no data field");
  } else if (count == 0) {
    sb_app_error_input(error, "has no channel %s (there are %s)",
                       wanted != NULL ? wanted : "of heights", list->str);
  }
  return count == 1 ? found : NULL;
}

static bool apply_mask(SbScan *out, const Channel *channel, GError **error) {
  Field mask;
  if (!read_field(&mask, &channel->mask, error)) {
    return false;
  }
  if (mask.rows != out->heights.rows || mask.columns != out->heights.columns) {
    return sb_app_error_input(error, "the mask has not the size of its data");
  }
  guint64 masked = 0;
  for (guint64 i = 0; i < mask.columns * mask.rows; i++) {
    if (sb_bytes_double(mask.data + 8 * i) >= 0.5) {
      out->heights.z[i] = NAN;
      masked++;
    }
  }
  if (masked > 0) {
    sb_note_add(out->notes,
                "%" G_GUINT64_FORMAT " masked points are missing, unless masks are ignored",
                masked);
  }
  return true;
}

static bool read_channel(SbScan *out, const Channel *channel, bool masked, GError **error) {
  Field field;
  if (!read_field(&field, &channel->data, error)) {
    return false;
  }
  const double xy = sb_scan_length(field.unit_xy), z = sb_scan_length(field.unit_z);
  if (!(xy > 0 && z > 0)) {
    return sb_app_error_input(error,
                              "units of the channel are not lengths (\"%s\", heights \"%s\")",
                              field.unit_xy, field.unit_z);
  }
  const SbScanBytes data = {field.data, field.data + 8 * field.columns * field.rows};
  if (!sb_scan_take_grid(out, field.columns, field.rows, SB_SCAN_DOUBLE, data, z, NAN, error)) {
    return false;
  }
  out->heights.dx = xy * field.width / (double)field.columns;
  out->heights.dy = xy * field.height / (double)field.rows;
  out->title = g_strdup(channel->title);
  return !masked || apply_mask(out, channel, error);
}

bool sb_scan_parse_gwy(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                       GError **error) {
  out->format = "Gwyddion";
  bytes.at += 4;
  SbScanBytes content;
  const char *class = take_object(&bytes, &content);
  if (class != NULL && strcmp(class, "GwyContainer") != 0) {
    return sb_app_error_input(error, "contains no GwyContainer");
  }
  g_autoptr(GArray) channels = g_array_new(FALSE, FALSE, sizeof(Channel));
  bool whole = class != NULL;
  while (whole && content.at < content.end) {
    Component each;
    whole = take_component(&each, &content);
    if (whole) {
      take_channel(channels, &each);
    }
  }
  if (!whole) {
    return sb_app_error_input(error, "is cut short, or no container of Gwyddion's");
  }
  const Channel *channel = choose(channels, choices->channel, error);
  return channel != NULL &&
         read_channel(out, channel, channel->mask.value != NULL && !choices->ignore_mask, error);
}
