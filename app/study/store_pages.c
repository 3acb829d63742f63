// What is left of a damaged store: its file in memory, completed to the length that its header
// states, and the rows of single pages when the tree that leads to them is damaged.
#include "app/study/store_private.h"

#include <string.h>

// Of the file format of SQLite: pages of a table without rowid, the header of the file and of a
// page.
enum {
  FILE_HEADER = 100,
  PAGE_SIZE_AT = 16,
  PAGE_COUNT_AT = 28,
  LEAF = 0x0a,
  INTERIOR = 0x02,
  CELLS_AT = 3,
  RIGHT_AT = 8,
  INTERIOR_HEADER = 12,
  IMAGE_MAX = 1 << 28 // of a short file [bytes]: a header may be damaged too
};

static size_t read_number(const guint8 *at, int bytes) {
  size_t value = 0;
  for (int i = 0; i < bytes; i++) {
    value = value << 8 | at[i];
  }
  return value;
}

static size_t page_size(const guint8 *image) {
  const size_t size = read_number(image + PAGE_SIZE_AT, 2);
  return size == 1 ? 65536 : size;
}

bool sb_store_load_image(SbStore *store) {
  char *bytes = NULL;
  gsize length = 0;
  if (!g_file_get_contents(store->path, &bytes, &length, NULL)) {
    return false;
  }
  const size_t size = length >= FILE_HEADER ? page_size((guint8 *)bytes) : 0;
  const size_t count = size > 0 ? read_number((guint8 *)bytes + PAGE_COUNT_AT, 4) : 0;
  const bool cut = size >= 512 && count * size > length;
  guint8 *image =
      cut && count * size <= MAX(IMAGE_MAX, 4 * length) ? g_try_realloc(bytes, count * size) : NULL;
  if (image == NULL) {
    g_free(bytes); // it is complete, no file of SQLite, or too large
    return false;
  }
  store->image = image;
  store->image_size = count * size;
  memset(store->image + length, 0, count * size - length);
  return true;
}

// A copy of the store's pages; NULL if they cannot be read.
static guint8 *copy_pages(size_t *size, SbStore *store) {
  if (store->image != NULL) {
    *size = store->image_size;
    return g_memdup2(store->image, store->image_size);
  }
  sqlite3_int64 length = 0;
  guint8 *own = sqlite3_serialize(store->file, "main", &length, 0);
  guint8 *copy = own != NULL ? g_memdup2(own, (gsize)length) : NULL;
  *size = (size_t)length;
  sqlite3_free(own);
  return copy;
}

// Leads all children of an interior page to the page `leaf`.
static void replace_children(guint8 *page, size_t size, guint32 leaf) {
  const guint32 child = GUINT32_TO_BE(leaf);
  const size_t cells = read_number(page + CELLS_AT, 2);
  memcpy(page + RIGHT_AT, &child, sizeof child);
  for (size_t i = 0; i < cells && INTERIOR_HEADER + 2 * i + 2 <= size; i++) {
    const size_t at = read_number(page + INTERIOR_HEADER + 2 * i, 2);
    if (at + sizeof child <= size) {
      memcpy(page + at, &child, sizeof child);
    }
  }
}

void sb_store_visit_pages(SbStore *store, SbStorePageVisit visit, void *data) {
  SbStore one = {.path = store->path, .format = store->format};
  const gint64 root =
      sb_store_number(store, "SELECT rootpage FROM sqlite_master WHERE name = 'answer'");
  g_autofree guint8 *pages = copy_pages(&one.image_size, store);
  const size_t size = pages != NULL && one.image_size >= FILE_HEADER ? page_size(pages) : 0;
  const size_t count = size >= 512 ? one.image_size / size : 0;
  if (root < 2 || (size_t)root > count) {
    return;
  }
  // Each page in turn takes the place of the root. An interior page needs a child with rows.
  guint32 leaf = 0;
  g_autofree guint8 *image = one.image = g_memdup2(pages, one.image_size);
  guint8 *place = image + ((size_t)root - 1) * size;
  for (int pass = 0; pass < 2; pass++) {
    const guint8 kind = pass == 0 ? LEAF : INTERIOR;
    for (size_t i = 1; i < count; i++) {
      const guint8 *page = pages + i * size;
      if (page[0] != kind || (kind == INTERIOR && leaf == 0)) {
        continue;
      }
      memcpy(place, page, size);
      if (kind == INTERIOR) {
        replace_children(place, size, leaf);
      }
      const bool rows = sb_store_open_file(&one, SQLITE_OPEN_READONLY, NULL) && visit(data, &one);
      leaf = rows && i + 1 != (size_t)root ? (guint32)i + 1 : leaf;
      sqlite3_close(one.file);
      one.file = NULL;
    }
  }
}
