// Scans written as their formats say, for the tests of the readers.
#pragma once

#include "engine/contact/rough/heights.h"
#include "tests/crc.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static inline void put_bytes(GByteArray *to, const void *bytes, gsize count) {
  g_byte_array_append(to, bytes, (guint)count);
}

static inline void put_text(GByteArray *to, const char *text) {
  put_bytes(to, text, strlen(text) + 1);
}

static inline void put_u32(GByteArray *to, guint32 value) {
  value = GUINT32_TO_LE(value);
  put_bytes(to, &value, sizeof value);
}

static inline void put_u16(GByteArray *to, guint16 value) {
  value = GUINT16_TO_LE(value);
  put_bytes(to, &value, sizeof value);
}

static inline void put_double(GByteArray *to, double value) {
  guint64 bits;
  memcpy(&bits, &value, sizeof bits);
  bits = GUINT64_TO_LE(bits);
  put_bytes(to, &bits, sizeof bits);
}

// ---- Gwyddion ----

static inline void put_object(GByteArray *to, const char *class, GByteArray *inside) {
  put_text(to, class);
  put_u32(to, inside->len);
  put_bytes(to, inside->data, inside->len);
  g_byte_array_unref(inside);
}

static inline void put_component(GByteArray *to, const char *name, char kind) {
  put_text(to, name);
  put_bytes(to, &kind, 1);
}

static inline void put_unit(GByteArray *to, const char *name, const char *unit) {
  GByteArray *inside = g_byte_array_new();
  put_component(inside, "unitstr", 's');
  put_text(inside, unit);
  put_component(to, name, 'o');
  put_object(to, "GwySIUnit", inside);
}

// A data field; `mask`: 1 where the heights are missing, else the heights, 0 where missing.
static inline void put_field(GByteArray *to, const char *name, const SbHeights *h, bool mask,
                             const char *unit) {
  GByteArray *field = g_byte_array_new();
  put_component(field, "xres", 'i');
  put_u32(field, (guint32)h->columns);
  put_component(field, "yres", 'i');
  put_u32(field, (guint32)h->rows);
  put_component(field, "xreal", 'd');
  put_double(field, (double)h->columns * h->dx);
  put_component(field, "yreal", 'd');
  put_double(field, (double)h->rows * h->dy);
  put_unit(field, "si_unit_xy", "m");
  put_unit(field, "si_unit_z", mask ? "" : unit);
  put_component(field, "data", 'D');
  put_u32(field, (guint32)(h->columns * h->rows));
  for (gsize i = 0; i < h->columns * h->rows; i++) {
    put_double(field, mask ? isnan(h->z[i]) : isnan(h->z[i]) ? 0 : h->z[i]);
  }
  put_component(to, name, 'o');
  put_object(to, "GwyDataField", field);
}

// A container of `channels` channels of heights, with a mask where points are missing, and of
// another quantity.
static inline GByteArray *write_gwy(const SbHeights *h, int channels) {
  GByteArray *inside = g_byte_array_new(), *out = g_byte_array_new();
  bool missing = false;
  for (gsize i = 0; i < h->columns * h->rows; i++) {
    missing |= isnan(h->z[i]);
  }
  for (int k = 0; k < channels; k++) {
    g_autofree char *data = g_strdup_printf("/%d/data", k);
    g_autofree char *title = g_strdup_printf("/%d/data/title", k);
    g_autofree char *text = g_strdup_printf("Topography %d", k);
    g_autofree char *mask = g_strdup_printf("/%d/mask", k);
    put_field(inside, data, h, false, "m");
    put_component(inside, title, 's');
    put_text(inside, text);
    if (missing) {
      put_field(inside, mask, h, true, "");
    }
  }
  put_component(inside, "/0/data/visible", 'b');
  put_bytes(inside, "\1", 1);
  put_field(inside, "/9/data", h, false, "V");
  put_bytes(out, "GWYP", 4);
  put_object(out, "GwyContainer", inside);
  return out;
}

// ---- Digital Surf ----

// Heights in steps of `step` [m]; missing ones two below the least.
static inline GByteArray *write_sur(const SbHeights *h, int bits, double step) {
  GByteArray *out = g_byte_array_new();
  g_byte_array_set_size(out, 512);
  memset(out->data, 0, 512);
  guchar *p = out->data;
  double least = INFINITY, most = -INFINITY;
  bool missing = false;
  for (gsize i = 0; i < h->columns * h->rows; i++) {
    missing |= isnan(h->z[i]);
    least = fmin(least, round(h->z[i] / step));
    most = fmax(most, round(h->z[i] / step));
  }
  memcpy(p, "DIGITAL SURF", 12);
  p[14] = 1;
  p[16] = 1;
  p[18] = h->rows > 1 ? 2 : 1;
  strcpy((char *)p + 20, "ring");
  p[86] = missing;
  p[98] = (guchar)bits;
  const gint32 numbers[] = {(gint32)least, (gint32)most, (gint32)h->columns, (gint32)h->rows,
                            (gint32)(h->columns * h->rows)};
  for (int i = 0; i < 5; i++) {
    const gint32 number = GINT32_TO_LE(numbers[i]);
    memcpy(p + 100 + 4 * i, &number, 4);
  }
  const float steps[] = {(float)(h->dx * 1e6), (float)(h->dy * 1e3), (float)(step * 1e9)};
  static const char *const units[] = {"\xb5m", "mm", "nm"};
  for (int i = 0; i < 3; i++) {
    guint32 word;
    memcpy(&word, &steps[i], 4);
    word = GUINT32_TO_LE(word);
    memcpy(p + 120 + 4 * i, &word, 4);
    strcpy((char *)p + 180 + 16 * i, units[i]);
    strcpy((char *)p + 228 + 16 * i, units[i]);
  }
  p[334] = 5; // a comment
  put_bytes(out, "worn\n", 5);
  for (gsize i = 0; i < h->columns * h->rows; i++) {
    const gint32 value = isnan(h->z[i]) ? (gint32)least - 2 : (gint32)round(h->z[i] / step);
    if (bits == 16) {
      put_u16(out, (guint16)(gint16)value);
    } else {
      put_u32(out, (guint32)value);
    }
  }
  return out;
}

// ---- X3P ----

// A zip with its members as they are.
static inline GByteArray *write_zip(const char *const *names, GByteArray *const *members,
                                    int count) {
  GByteArray *out = g_byte_array_new(), *directory = g_byte_array_new();
  for (int i = 0; i < count; i++) {
    const guint32 sum = crc(members[i]->data, members[i]->len), begin = out->len;
    for (int central = 0; central < 2; central++) {
      GByteArray *to = central ? directory : out;
      put_u32(to, central ? 0x02014b50 : 0x04034b50);
      if (central) {
        put_u16(to, 20);
      }
      put_u16(to, 20);
      put_u16(to, 0);
      put_u16(to, 0);
      put_u32(to, 0x00210000); // 1980-01-01
      put_u32(to, sum);
      put_u32(to, members[i]->len);
      put_u32(to, members[i]->len);
      put_u16(to, (guint16)strlen(names[i]));
      put_u16(to, 0);
      if (central) {
        put_u16(to, 0);
        put_u16(to, 0);
        put_u16(to, 0);
        put_u32(to, 0);
        put_u32(to, begin);
      }
      put_bytes(to, names[i], strlen(names[i]));
    }
    put_bytes(out, members[i]->data, members[i]->len);
  }
  const guint32 begin = out->len;
  put_bytes(out, directory->data, directory->len);
  put_u32(out, 0x06054b50);
  put_u32(out, 0);
  put_u16(out, (guint16)count);
  put_u16(out, (guint16)count);
  put_u32(out, directory->len);
  put_u32(out, begin);
  put_u16(out, 0);
  g_byte_array_unref(directory);
  return out;
}

// `type` as ISO 5436-2: I and L in steps of `step` [m] with a member of valid points, F and D with
// numbers that are none.
static inline GByteArray *write_x3p(const SbHeights *h, char type, double step) {
  GByteArray *data = g_byte_array_new(), *valid = g_byte_array_new(), *main = g_byte_array_new();
  const gsize points = h->columns * h->rows;
  g_byte_array_set_size(valid, (guint)(points + 7) / 8);
  memset(valid->data, 0, valid->len);
  for (gsize i = 0; i < points; i++) {
    const double value = h->z[i] / step;
    const gint32 whole = isnan(value) ? 0 : (gint32)round(value);
    valid->data[i / 8] |= (guint8)(!isnan(value) << (i % 8));
    if (type == 'I') {
      put_u16(data, (guint16)(gint16)whole);
    } else if (type == 'L') {
      put_u32(data, (guint32)whole);
    } else if (type == 'F') {
      const float number = (float)value;
      guint32 bits;
      memcpy(&bits, &number, sizeof bits);
      put_u32(data, bits);
    } else {
      put_double(data, value);
    }
  }
  const bool bits = type == 'I' || type == 'L';
  char dx[G_ASCII_DTOSTR_BUF_SIZE], dy[G_ASCII_DTOSTR_BUF_SIZE], dz[G_ASCII_DTOSTR_BUF_SIZE];
  g_autofree char *xml = g_strdup_printf(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">\n"
      " <Record1><Revision>ISO5436 - 2000</Revision><FeatureType>%s</FeatureType><Axes>\n"
      "  "
      "<CX><AxisType>I</AxisType><DataType>D</DataType><Increment>%s</Increment><Offset>0</"
      "Offset></CX>\n"
      "  "
      "<CY><AxisType>I</AxisType><DataType>D</DataType><Increment>%s</Increment><Offset>0</"
      "Offset></CY>\n"
      "  "
      "<CZ><AxisType>A</AxisType><DataType>%c</DataType><Increment>%s</Increment><Offset>0</"
      "Offset></CZ>\n"
      " </Axes></Record1>\n <Record2><Comment>&lt;ring&gt;</Comment></Record2>\n"
      " <Record3><MatrixDimension><SizeX>%" G_GSIZE_FORMAT "</SizeX><SizeY>%" G_GSIZE_FORMAT
      "</SizeY><SizeZ>1</SizeZ></MatrixDimension>\n  <DataLink><PointDataLink>bindata/data.bin"
      "</PointDataLink>%s</DataLink></Record3>\n</p:ISO5436_2>\n",
      h->rows > 1 ? "SUR" : "PRF", g_ascii_dtostr(dx, sizeof dx, h->dx),
      g_ascii_dtostr(dy, sizeof dy, h->rows > 1 ? h->dy : 1), type,
      g_ascii_dtostr(dz, sizeof dz, step), h->columns, h->rows,
      bits ? "<ValidPointsLink>bindata/valid.bin</ValidPointsLink>" : "");
  put_bytes(main, xml, strlen(xml));
  GByteArray *members[] = {main, data, valid};
  GByteArray *out =
      write_zip((const char *const[]){"main.xml", "bindata/data.bin", "bindata/valid.bin"}, members,
                bits ? 3 : 2);
  for (gsize i = 0; i < G_N_ELEMENTS(members); i++) {
    g_byte_array_unref(members[i]);
  }
  return out;
}
