// Runs a fuzz target over its corpus and over seeded mutations of it, so that ./check needs no
// fuzzing engine: replay CORPUS. The slow mode makes more mutations.
#include <glib.h>
#include <stdint.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const char *corpus;
static GPtrArray *inputs; // GBytes

static void test_corpus(void) {
  for (guint i = 0; i < inputs->len; i++) {
    gsize size = 0;
    const uint8_t *data = g_bytes_get_data(inputs->pdata[i], &size);
    LLVMFuzzerTestOneInput(data, size);
  }
}

// Replaces, inserts, removes and doubles pieces, with bytes that mean something to the format.
static void test_mutations(void) {
  enum { CHANGES = 6 };
  int rounds = g_test_slow() ? 4000 : 150;
  static const char alphabet[] = "[]=#;.\n\r -+0123456789eEmMPaµ\xff\x01/ansif";
  GRand *random = g_rand_new_with_seed(20);
  for (int round = 0; round < rounds; round++) {
    GBytes *seed = inputs->pdata[g_rand_int_range(random, 0, (gint32)inputs->len)];
    gsize size = 0;
    const uint8_t *data = g_bytes_get_data(seed, &size);
    GByteArray *bytes = g_byte_array_new();
    g_byte_array_append(bytes, data, (guint)size);
    int changes = g_rand_int_range(random, 1, CHANGES);
    for (int c = 0; c < changes && bytes->len > 0; c++) {
      guint at = (guint)g_rand_int_range(random, 0, (gint32)bytes->len);
      guint piece = (guint)g_rand_int_range(random, 1, 60);
      guint8 byte = (guint8)alphabet[g_rand_int_range(random, 0, sizeof alphabet)];
      switch (g_rand_int_range(random, 0, 4)) {
      case 0:
        bytes->data[at] = byte;
        break;
      case 1:
        g_byte_array_append(bytes, &byte, 1);
        memmove(bytes->data + at + 1, bytes->data + at, bytes->len - at - 1);
        bytes->data[at] = byte;
        break;
      case 2:
        g_byte_array_remove_range(bytes, at, MIN(piece, bytes->len - at));
        break;
      default:
        for (guint k = 0; k < MIN(piece, bytes->len - at); k++) {
          guint8 again = bytes->data[at + k];
          g_byte_array_append(bytes, &again, 1);
        }
      }
    }
    LLVMFuzzerTestOneInput(bytes->data, bytes->len);
    g_byte_array_unref(bytes);
  }
  g_rand_free(random);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  corpus = argv[1];
  inputs = g_ptr_array_new_with_free_func((GDestroyNotify)g_bytes_unref);
  GDir *dir = g_dir_open(corpus, 0, NULL);
  g_assert_nonnull(dir);
  const char *name;
  while ((name = g_dir_read_name(dir)) != NULL) {
    char *path = g_build_filename(corpus, name, NULL);
    char *text = NULL;
    gsize length = 0;
    g_assert_true(g_file_get_contents(path, &text, &length, NULL));
    g_ptr_array_add(inputs, g_bytes_new_take(text, length));
    g_free(path);
  }
  g_dir_close(dir);
  g_assert_cmpuint(inputs->len, >, 0);
  g_test_add_func("/fuzz/corpus", test_corpus);
  g_test_add_func("/fuzz/mutations", test_mutations);
  int result = g_test_run();
  g_ptr_array_unref(inputs);
  return result;
}
