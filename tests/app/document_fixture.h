// Documents in tests: shipped files, and folders for others.
#pragma once

#include "app/document/document.h"

// Returns the path of a shipped file. Freed by g_free().
char *document_asset(const char *name);

// Reads a document, which must have no issue. Freed by sb_document_free().
SbDocument *document_load(const char *path);

// Returns the path of a new folder. Freed by document_remove_folder().
char *document_folder(void);

// Removes a folder with its files and frees its path.
void document_remove_folder(char *folder);
