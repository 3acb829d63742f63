// The outputs of a table of results: each has its columns, and the same cell everywhere.
#include "app/table/table.h"

#include <math.h>
#include <string.h>

static const SbTableColumn columns[] = {
    {"name", "  %-*s", "", "", 0},
    {"length_m", " %9s", "length", "length", 0},
    {.key = "known", .label = "known"},
    {.key = "reason", .layout = "  (%s)", .label = "why"},
};

// A row with a letter of two bytes, one that CSV and HTML must mark, and one without values.
static SbTable *make_table(void) {
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  char name[] = "µ";
  sb_table_add(table, SB_CELLS(sb_cell_text(name), sb_cell_quantity(1.23456e-3, "m", "mm", 3),
                               sb_cell_answer(true), sb_cell_text(NULL)));
  name[0] = '\0'; // texts are copied
  sb_table_note(table, "between");
  sb_table_add(table, SB_CELLS(sb_cell_text("=a;\"b\" & c"), sb_cell_number(NAN),
                               sb_cell_answer(NAN), sb_cell_text_as("long", "short")));
  sb_table_mark(table, SB_TABLE_WRONG);
  sb_table_add(table, SB_CELLS(sb_cell_text("d"), sb_cell_number_as(5, "five"), {0}, {0}));
  return table;
}

static void test_text(void) {
  g_autoptr(SbTable) table = make_table();
  g_autofree char *text = sb_table_text(table);
  g_assert_cmpstr(text, ==,
                  "                length\n"
                  "  µ            1.23 mm\n"
                  "between\n"
                  "  =a;\"b\" & c         -  (short)\n"
                  "  d               five\n");
  g_autoptr(SbTable) empty = sb_table_new(columns, G_N_ELEMENTS(columns));
  g_autofree char *nothing = sb_table_text(empty);
  g_assert_cmpstr(nothing, ==, "");
}

static void test_csv(void) {
  g_autoptr(SbTable) table = make_table();
  char *text = NULL;
  size_t size = 0;
  FILE *stream = open_memstream(&text, &size);
  sb_table_csv(stream, table);
  fclose(stream);
  g_assert_cmpstr(text, ==,
                  "name,length_m,known,reason\n"
                  "µ,0.00123456,1,\n"
                  "\"'=a;\"\"b\"\" & c\",,,long\n"
                  "d,5,,\n");
  free(text);
}

static void test_json(void) {
  g_autoptr(SbTable) table = make_table();
  SbJson json;
  sb_json_init(&json);
  sb_table_json(&json, NULL, table);
  g_autofree char *text = sb_json_finish(&json);
  g_auto(GStrv) words = g_strsplit_set(text, " \n", -1);
  g_autoptr(GString) packed = g_string_new(NULL);
  for (char **word = words; *word != NULL; word++) {
    g_string_append(packed, *word);
  }
  g_assert_cmpstr(
      packed->str, ==,
      "[{\"name\":\"µ\",\"length_m\":0.00123456,\"known\":true,\"reason\":null},"
      "{\"name\":\"=a;\\\"b\\\"&c\",\"length_m\":null,\"known\":null,\"reason\":\"long\"},"
      "{\"name\":\"d\",\"length_m\":5}]");
}

static void test_members(void) {
  static const SbTableColumn named[] = {{.layout = "%s"}, {.key = "force_N"}};
  g_autoptr(SbTable) table = sb_table_new(named, G_N_ELEMENTS(named));
  sb_table_add(table, SB_CELLS(sb_cell_text_as("B", "Stage B"), sb_cell_number(2)));
  sb_table_note(table, "a note is in no file");
  SbJson json;
  sb_json_init(&json);
  sb_table_json(&json, NULL, table);
  g_autofree char *text = sb_json_finish(&json);
  g_assert_cmpstr(text, ==, "{\n  \"B\": {\n    \"force_N\": 2\n  }\n}\n");
}

static void test_pages(void) {
  g_autoptr(SbTable) table = make_table();
  g_autofree char *html = sb_table_html(table), *markdown = sb_table_markdown(table);
  g_assert_nonnull(strstr(html,
                          "<table><tr><th></th><th>length</th><th>known</th><th>why</th></tr>\n"
                          "<tr><td>µ</td><td class=\"n\">1.23 mm</td><td>yes</td><td></td></tr>\n"
                          "<tr class=\"fails\"><td>=a;&quot;b&quot; &amp; c</td>"));
  g_assert_true(g_str_has_prefix(markdown, "| | length | known | why |\n|---|---|---|---|\n"
                                           "| µ | 1.23 mm | yes |  |\n"
                                           "| =a;\"b\" & c | - | - | short |\n"));
}

// What a page of a report reads: rows in their order, notes and marks, and texts that the table
// took.
static void test_rows(void) {
  g_autoptr(SbTable) table = make_table();
  sb_table_add(table, SB_CELLS(sb_cell_own(g_strdup("own")), sb_cell_shown(g_strdup("1 mm")),
                               sb_cell_shown(NULL), sb_cell_own(NULL)));
  size_t count;
  g_assert_true(sb_table_columns(table, &count) == columns);
  g_assert_cmpuint(count, ==, G_N_ELEMENTS(columns));
  g_assert_cmpstr(sb_table_row(table, 1)->note, ==, "between");
  g_assert_cmpint(sb_table_row(table, 2)->mark, ==, SB_TABLE_WRONG);
  const SbTableRow *last = sb_table_row(table, 4);
  g_assert_cmpstr(last->cell[0].text, ==, "own");
  static const char *const shown[] = {"own", "1 mm", "", ""};
  for (size_t k = 0; k < count; k++) {
    g_autofree char *text = sb_table_shown(&last->cell[k]);
    g_assert_cmpstr(text, ==, shown[k]);
  }
  g_assert_null(sb_table_row(table, 5));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/table/text", test_text);
  g_test_add_func("/table/csv", test_csv);
  g_test_add_func("/table/json", test_json);
  g_test_add_func("/table/members", test_members);
  g_test_add_func("/table/pages", test_pages);
  g_test_add_func("/table/rows", test_rows);
  return g_test_run();
}
