// Gwyddion's container: GWYP, then an object: its name, the bytes that it takes, its components,
// each a name, a letter for the kind and the value. Numbers are little-endian. Taken are
// "/N/data" (GwyDataField: xres, yres, xreal, yreal, si_unit_xy, si_unit_z, data), "/N/data/title"
// and "/N/mask", whose points of 0.5 and more are missing; everything else is stepped over.
#include "app/data/scan/scan_private.h"

#include <stdio.h>

enum { CHANNELS_MAX = 1024, COMPONENTS_MAX = 100000 };

typedef struct {
  const char *name;
  char kind;
  const guchar *value; // begins here; of an array behind its count
  size_t count;        // of an array, or bytes of an object behind its head; 0: absent
  const char *object;  // its class
} Component;

// Steps over `count` bytes and returns them; NULL if there are fewer.
static const guchar *take(SbScanBytes *bytes, size_t count) {
  const guchar *at = bytes->at;
  if (count > (size_t)(bytes->end - at)) {
    return NULL;
  }
  bytes->at += count;
  return at;
}

// A text with its end within the bytes; NULL without.
static const char *take_text(SbScanBytes *bytes) {
  const size_t left = (size_t)(bytes->end - bytes->at);
  const size_t length = strnlen((const char *)bytes->at, left);
  return length < left ? (const char *)take(bytes, length + 1) : NULL;
}

// Returns the class of an object and writes its content; NULL if it is not complete.
static const char *take_object(SbScanBytes *bytes, SbScanBytes *content) {
  const char *name = take_text(bytes);
  const guchar *size = name != NULL ? take(bytes, 4) : NULL;
  content->at = size != NULL ? take(bytes, sb_bytes_u32(size)) : NULL;
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
  const guchar *length = one != out->kind ? take(bytes, 4) : NULL;
  if (one != out->kind && length == NULL) {
    return false;
  }
  out->value = bytes->at;
  const size_t count = out->count = length != NULL ? sb_bytes_u32(length) : 1;
  if (number != NULL) {
    return take(bytes, sizes[number - numbers] * count) != NULL;
  }
  const char *text = "";
  for (size_t k = 0; k < count && text != NULL; k++) {
    SbScanBytes content = *bytes;
    text = one == 's' ? take_text(bytes) : one == 'o' ? take_object(bytes, &content) : NULL;
    if (out->kind == 'o' && text != NULL) {
      out->object = text;
      out->value = content.at;
      out->count = (size_t)(content.end - content.at);
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

typedef struct {
  size_t columns, rows;
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

// The number of a component; 0 without.
static double number_of(const Component *field, char kind, const char *name) {
  Component number;
  return !find(&number, field, kind, name) ? 0
         : kind == 'i'                     ? sb_bytes_u32(number.value)
                                           : sb_bytes_double(number.value);
}

static bool read_field(Field *out, const Component *field, GError **error) {
  Component data;
  const bool known = find(&data, field, 'D', "data") && data.count > 0;
  *out = (Field){(size_t)number_of(field, 'i', "xres"),
                 (size_t)number_of(field, 'i', "yres"),
                 number_of(field, 'd', "xreal"),
                 number_of(field, 'd', "yreal"),
                 unit_of(field, "si_unit_xy"),
                 unit_of(field, "si_unit_z"),
                 data.value};
  return (known && out->columns * out->rows == data.count) ||
         sb_app_error_input(error, "a data field's size is not that of its data");
}

// Finds "/ID/NAME" in the container.
static bool find_of(Component *out, const Component *from, char kind, long id, const char *name) {
  g_autofree char *path = g_strdup_printf("/%ld/%s", id, name);
  return find(out, from, kind, path);
}

// Finds the data of the channel that is requested, else of the only one of heights, and the title,
// whose value is NULL if there is none. Returns the channel's number; -1 with an error.
static long choose(Component *data, Component *title, const Component *container,
                   const char *wanted, GError **error) {
  SbScanBytes inside = {container->value, container->value + container->count};
  int count = 0, components = 0, fields = 0;
  long found = -1;
  g_autoptr(GString) list = g_string_new(NULL), fitting = g_string_new(NULL);
  while (inside.at < inside.end) {
    Component each, own;
    Field field;
    long id = 0;
    int end = 0;
    if (!take_component(&each, &inside) || components++ > COMPONENTS_MAX) {
      sb_app_error_input(error, "is cut short, or no container of Gwyddion's");
      return -1;
    }
    if (g_strcmp0(each.object, "GwyDataField") != 0 || fields > CHANNELS_MAX ||
        sscanf(each.name, "/%ld/data%n", &id, &end) != 1 || id < 0 || end == 0 ||
        each.name[end] != '\0') {
      continue;
    }
    fields++;
    (void)find_of(&own, container, 's', id, "data/title");
    g_autofree char *number = g_strdup_printf("%ld", id);
    const char *text = (const char *)own.value;
    if (wanted != NULL ? strcmp(number, wanted) == 0 || g_strcmp0(text, wanted) == 0
                       : read_field(&field, &each, NULL) && sb_scan_length(field.unit_z) > 0) {
      g_string_append_printf(fitting, "%s%s", count++ > 0 ? "\n" : "", number);
      found = id;
      *data = each;
      *title = own;
    }
    if (list->len < 200) {
      g_string_append_printf(list, "%s%s", list->len > 0 ? ", " : "", number);
      g_string_append_printf(list, text != NULL ? " \"%s\"" : "%s", text != NULL ? text : "");
    }
  }
  if (count > 1) {
    sb_app_error_choose(error, "channel", fitting->str, "has %d channels%s (%s)", count,
                        wanted != NULL ? " of that title" : " of heights", list->str);
  } else if (count == 0 && list->len == 0) {
    sb_app_error_input(error, "has no data field");
  } else if (count == 0) {
    sb_app_error_input(error, "has no channel %s (numbers and titles: %s)",
                       wanted != NULL ? wanted : "of heights in a unit of length", list->str);
  }
  return count == 1 ? found : -1;
}

static bool apply_mask(SbScan *out, const Component *field, GError **error) {
  Field mask;
  if (!read_field(&mask, field, error)) {
    return false;
  }
  if (mask.rows != out->heights.rows || mask.columns != out->heights.columns) {
    return sb_app_error_input(error, "the mask has not the size of its data");
  }
  size_t masked = 0;
  for (size_t i = 0; i < mask.columns * mask.rows; i++) {
    if (sb_bytes_double(mask.data + 8 * i) >= 0.5) {
      out->heights.z[i] = NAN;
      masked++;
    }
  }
  if (masked > 0) {
    sb_note_add(out->notes, "%zu masked points are missing, unless masks are ignored", masked);
  }
  return true;
}

bool sb_scan_parse_gwy(SbScan *out, SbScanBytes file, const SbScanChoices *wish, GError **error) {
  out->format = "Gwyddion";
  file.at += 4;
  SbScanBytes content;
  const char *class = take_object(&file, &content);
  if (g_strcmp0(class, "GwyContainer") != 0) {
    return sb_app_error_input(error, "contains no GwyContainer, or is cut short");
  }
  const Component container = {.value = content.at, .count = (size_t)(content.end - content.at)};
  Component data, title = {0}, mask;
  Field field;
  const long id = choose(&data, &title, &container, wish->channel, error);
  if (id < 0 || !read_field(&field, &data, error)) {
    return false;
  }
  const double xy = sb_scan_length(field.unit_xy), z = sb_scan_length(field.unit_z);
  if (!(xy > 0 && z > 0)) {
    return sb_app_error_input(error,
                              "units of the channel are not lengths (\"%s\", heights \"%s\")",
                              field.unit_xy, field.unit_z);
  }
  const SbScanBytes numbers = {field.data, field.data + 8 * field.columns * field.rows};
  if (!sb_scan_take_grid(out, field.columns, field.rows, 'd', numbers, z, NAN, error)) {
    return false;
  }
  out->heights.dx = xy * field.width / (double)field.columns;
  out->heights.dy = xy * field.height / (double)field.rows;
  out->title = g_strdup((const char *)title.value);
  return wish->ignore_mask || !find_of(&mask, &container, 'o', id, "mask") ||
         g_strcmp0(mask.object, "GwyDataField") != 0 || apply_mask(out, &mask, error);
}
