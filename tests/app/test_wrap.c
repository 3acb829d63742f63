// Lines that wrap at words: nothing of a line is lost, no line is wider than the terminal, and
// continuation lines are indented.
#include "app/cli/wrap.h"

#include <string.h>

static void wraps(const char *text, int columns, const char *expected) {
  g_autofree char *wrapped = sb_wrap_line(text, columns);
  g_assert_cmpstr(wrapped, ==, expected);
}

static void test_words(void) {
  wraps("short", 40, "short");
  wraps("one two three four five six seven", 20, "one two three four\n    five six seven");
  // A column stays a column where it leaves room, and a long word is not cut.
  wraps("  Label      a value (with a reason that is long)", 40,
        "  Label      a value (with a reason that\n             is long)");
  wraps("  A label that is long      value", 24, "  A label that is long\n      value");
  wraps("see /a/path/that/is/longer/than/the/line now", 20,
        "see\n    /a/path/that/is/longer/than/the/line\n    now");
  wraps("ünï ünï ünï ünï ünï ünï", 20, "ünï ünï ünï ünï ünï\n    ünï");
  // Pictures and pipes.
  wraps("\033[1m one two three four five six", 20, "\033[1m one two three four five six");
  wraps("one two three four five six seven", 0, "one two three four five six seven");
}

// Random lines: the words in order, and widths that fit unless one word is too long.
static void test_random(void) {
  GRand *random = g_rand_new_with_seed(5);
  for (int i = 0; i < 2000; i++) {
    g_autoptr(GString) line = g_string_new(NULL);
    for (int k = g_rand_int_range(random, 0, 30); k >= 0; k--) {
      g_string_append_printf(line, "%.*s%.*s", g_rand_int_range(random, 1, 12), "abcdefghijkl",
                             g_rand_int_range(random, 1, 4), "    ");
    }
    const int columns = g_rand_int_range(random, 30, 100);
    g_autofree char *wrapped = sb_wrap_line(line->str, columns);
    g_auto(GStrv) lines = g_strsplit(wrapped, "\n", -1);
    for (char **each = lines; *each != NULL; each++) {
      g_strchomp(*each);
      g_assert_cmpint(sb_wrap_width(*each), <=, columns);
    }
    g_auto(GStrv) a = g_strsplit_set(line->str, " \n", -1), b = g_strsplit_set(wrapped, " \n", -1);
    g_autofree char *one = g_strjoinv("", a), *two = g_strjoinv("", b);
    g_assert_cmpstr(one, ==, two);
  }
  g_rand_free(random);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/wrap/words", test_words);
  g_test_add_func("/wrap/random", test_random);
  return g_test_run();
}
