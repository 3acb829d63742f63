// Errors of a document's files. A value with an error keeps its default, which the author of the
// file did not ask for: so such a document does not compile, and nothing is computed from it, until
// every error is corrected. An edit of the key corrects an error of a value; an edit that makes a
// case of [cases] possible corrects that case. Everything else is corrected in the file.
#include "app/document/document_private.h"

#include <string.h>

void sb_document_add_faults(SbDocument *document, const GPtrArray *issues, guint first) {
  for (guint i = first; i < issues->len; i++) {
    sb_issues_add_copy(document->faults, issues->pdata[i]);
  }
}

// Whether an edit gave the key at fault a value that its file does not give, or made its case
// possible.
static bool is_corrected(const SbDocument *document, const SbIssue *fault) {
  if (fault->key != NULL && g_str_has_prefix(fault->key, SB_CASES_GROUP ".")) {
    return sb_document_case_is_good(document, fault->key + strlen(SB_CASES_GROUP "."));
  }
  const int id = fault->key != NULL ? sb_param_find(fault->key) : -1;
  return id >= 0 && document->own.given[id] && !document->saved.given[id];
}

bool sb_document_faults(const SbDocument *document, GPtrArray *issues) {
  bool any = false;
  for (guint i = 0; i < document->faults->len; i++) {
    const SbIssue *fault = document->faults->pdata[i];
    if (!is_corrected(document, fault)) {
      any = true;
      if (issues != NULL) {
        sb_issues_add_copy(issues, fault);
      }
    }
  }
  return any;
}

void sb_document_faults_saved(SbDocument *document) {
  for (guint i = document->faults->len; i-- > 0;) {
    if (is_corrected(document, document->faults->pdata[i])) {
      g_ptr_array_remove_index(document->faults, i);
    }
  }
}

SbDocument *sb_document_new_refused(const GPtrArray *issues) {
  SbDocument *document = sb_document_new();
  sb_document_add_faults(document, issues, 0);
  return document;
}
