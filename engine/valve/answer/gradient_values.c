// Memory and results of a gradient.
#include "engine/valve/answer/gradient_private.h"

#include <stdlib.h>
#include <string.h>

void sb_gradient_destroy(SbGradient *gradient) {
  if (gradient != NULL) {
    free(gradient->figure);
    free(gradient->parameter);
    free(gradient->at);
    free(gradient->value);
    free(gradient->value_error);
    free(gradient->slope);
    free(gradient->error);
    free(gradient->why);
    free(gradient->solved);
    free(gradient->fixed);
    free(gradient);
  }
}

size_t sb_gradient_figures(const SbGradient *gradient) {
  return gradient->figures;
}

size_t sb_gradient_parameters(const SbGradient *gradient) {
  return gradient->parameters;
}

int sb_gradient_figure(const SbGradient *gradient, size_t figure) {
  return gradient->figure[figure];
}

SbParamId sb_gradient_parameter(const SbGradient *gradient, size_t parameter) {
  return gradient->parameter[parameter];
}

double sb_gradient_at(const SbGradient *gradient, size_t parameter) {
  return gradient->at[parameter];
}

double sb_gradient_value(const SbGradient *gradient, size_t figure) {
  return gradient->value[figure];
}

double sb_gradient_value_error(const SbGradient *gradient, size_t figure) {
  return gradient->value_error[figure];
}

double sb_gradient_slope(const SbGradient *gradient, size_t figure, size_t parameter) {
  return gradient->slope[figure * gradient->parameters + parameter];
}

double sb_gradient_error(const SbGradient *gradient, size_t figure, size_t parameter) {
  return gradient->error[figure * gradient->parameters + parameter];
}

const char *sb_gradient_reason(const SbGradient *gradient, size_t figure, size_t parameter) {
  const unsigned char number = gradient->why[figure * gradient->parameters + parameter];
  return number > 0 ? gradient->text[number - 1] : NULL;
}

bool sb_gradient_is_solved(const SbGradient *gradient, size_t figure, size_t parameter) {
  return gradient->solved[figure * gradient->parameters + parameter];
}

bool sb_gradient_is_fixed(const SbGradient *gradient, size_t figure, size_t parameter) {
  return gradient->fixed[figure * gradient->parameters + parameter];
}

bool sb_gradient_wants(SbParamId id) {
  return sb_param(id)->kind == SB_PARAM_REAL;
}

SbGradient *sb_gradient_make(const SbQuestion *question, const SbParamId *parameter, size_t count) {
  SbGradient *out = calloc(1, sizeof *out);
  if (out == NULL) {
    return NULL;
  }
  const size_t n = question->figure_count, cells = n * count;
  out->figures = n;
  out->parameters = count;
  // One more: an array of none may be NULL.
  out->figure = calloc(n + 1, sizeof *out->figure);
  out->parameter = calloc(count + 1, sizeof *out->parameter);
  out->at = calloc(count + 1, sizeof *out->at);
  out->value = calloc(n + 1, sizeof *out->value);
  out->value_error = calloc(n + 1, sizeof *out->value_error);
  out->slope = calloc(cells + 1, sizeof *out->slope);
  out->error = calloc(cells + 1, sizeof *out->error);
  out->why = calloc(cells + 1, sizeof *out->why);
  out->solved = calloc(cells + 1, sizeof *out->solved);
  out->fixed = calloc(cells + 1, sizeof *out->fixed);
  if (out->figure == NULL || out->parameter == NULL || out->at == NULL || out->value == NULL ||
      out->value_error == NULL || out->slope == NULL || out->error == NULL || out->why == NULL ||
      out->solved == NULL || out->fixed == NULL) {
    sb_gradient_destroy(out);
    return NULL;
  }
  for (size_t i = 0; i < n; i++) {
    out->figure[i] = question->figure[i];
  }
  for (size_t i = 0; i < count; i++) {
    out->parameter[i] = parameter[i];
  }
  return out;
}

unsigned char sb_gradient_text(SbGradient *gradient, const char *text) {
  char own[SB_GRADIENT_TEXT];
  sb_text(own, sizeof own, "%s", text);
  size_t at = 0;
  while (at < gradient->text_count && strcmp(gradient->text[at], own) != 0) {
    at++;
  }
  if (at == SB_GRADIENT_TEXTS) {
    sb_text(gradient->text[--at], SB_GRADIENT_TEXT,
            "one of several reasons: request fewer parameters");
  } else if (at == gradient->text_count) {
    memcpy(gradient->text[gradient->text_count++], own, sizeof own);
  }
  return (unsigned char)(at + 1);
}
