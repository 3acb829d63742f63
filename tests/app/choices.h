// Compares the choice that resolves a refusal.
#pragma once

#include "app/base/choice.h"

#include <string.h>

// The key and the values, one a line; and the message without its remedy contains no option.
static inline void assert_choice(const SbChoice *choice, const char *message, const char *key,
                                 const char *values) {
  g_assert_nonnull(choice);
  g_assert_cmpstr(choice->key, ==, key);
  g_autofree char *all = g_strjoinv("\n", choice->value); // "" for no value and for ""
  g_assert_cmpstr(all, ==, values);
  g_autofree char *problem = sb_choice_problem(choice, message);
  g_assert_cmpuint(strlen(problem), >, 0);
  g_assert_true(g_str_has_prefix(message, problem));
  g_assert_null(strstr(problem, "--"));
  g_assert_null(strstr(problem, "specify it"));
}
