// What any bytes must survive as a valve or scene file: reading never crashes, hangs or says
// nothing; a document that was read writes back to a text with the same values.
#include "app/document/document.h"

#include <stdint.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  GPtrArray *issues = sb_issues_new();
  SbDocument *document = sb_document_parse((const char *)data, size, "fuzz", NULL, issues);
  g_assert_true(document != NULL || issues->len > 0);
  for (guint i = 0; i < issues->len; i++) {
    char *line = sb_issue_line(issues->pdata[i]);
    g_assert_true(g_utf8_validate(line, -1, NULL) && strchr(line, '\n') == NULL);
    g_free(line);
  }
  if (document != NULL) {
    // As it was read, with issues too: a window shows it so.
    g_assert_false(sb_document_is_modified(document));
    g_free(sb_document_to_text(document, NULL));
  }
  if (document != NULL && issues->len == 0) {
    // An edit, then out and in again.
    g_assert_true(sb_document_set(document, SB_P_SEAL_OUTER_MODULUS, "2.25 MPa", NULL));
    sb_document_unset(document, SB_P_GLAND_RADIAL_SPACE);
    char *text = sb_document_to_text(document, NULL);
    SbDocument *again = sb_document_parse(text, strlen(text), "fuzz", NULL, issues);
    g_assert_nonnull(again);
    char *one = sb_document_sha256(document);
    char *two = sb_document_sha256(again);
    g_assert_cmpstr(one, ==, two);
    g_free(one);
    g_free(two);
    g_free(text);
    sb_document_free(again);
  }
  sb_document_free(document);
  g_ptr_array_unref(issues);
  return 0;
}
