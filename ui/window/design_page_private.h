// Shared by the files of the page Design: design_page.c (results, search and layout),
// design_page_map.c (the map's picked point) and design_page_form.c (what is requested).
#pragma once

#include "app/export/design_map.h"
#include "app/session/design_job.h"
#include "ui/views/draw_cache.h"
#include "ui/views/later.h"
#include "ui/window/design_page.h"

// Drawing areas of the page.
typedef enum {
  SB_DESIGN_AREA_MAP,
  SB_DESIGN_AREA_TORNADO,
  SB_DESIGN_AREA_SCATTER,
  SB_DESIGN_AREAS
} SbDesignPageArea;

// Maximum number of figures that can be the goal.
enum { SB_DESIGN_PAGE_GOALS = 64 };

// The page. Freed with its widget `box`; the other widgets are children of `box`.
typedef struct {
  SbSession *session; // owned reference
  SbDesignAsk ask;    // what is requested
  GtkWidget *box, *axis[2], *lines[SB_DESIGN_LINES], *goal, *models, *ranges,
      *area[SB_DESIGN_AREAS], *limits, *side, *side_button, *progress, *pause, *stop, *map_again,
      *find, *message, *marks;
  GtkWidget *picked, *told, *open, *pin, *use_best; // `told`: the line of models
  int kind;                                         // kind of the valve, for which `ask` is
  SbDrawCache *cache[SB_DESIGN_AREAS];              // pictures of `area`
  SbDesignJob *job;                                 // running computation, owned; NULL: none
  SbDesignAnswer *answer;                           // last results, owned; NULL: none
  SbStore *store;                                   // store of evaluations, owned; NULL: not open
  SbDesignLook look;                                // lines that are drawn, and the picked point
  int chosen;                      // index of the figure (sb_figure()) whose effects are drawn
  int goals[SB_DESIGN_PAGE_GOALS]; // [goal_count]: figures of the choice `goal`
  size_t goal_count;
  SbLater poll, later, room;  // progress of `job`; delayed computation; delayed layout
  char *hash;                 // sb_document_sha256() of the values of the last computation, owned
  const SbDocument *document; // the document that `ask` belongs to; only compared
  gboolean narrow;            // there is no room for both columns
  gboolean refreshing;        // the program, not the user, changes the widgets
  size_t shown_done;          // points of the map that were drawn last
  SbDesignPart shown_part;    // part of `job` that was shown last
} SbDesignPage;

// Returns the results to draw: those of the running job, otherwise the last ones; NULL: none. Only
// read, and valid until sb_design_page_release(), which the caller calls soon and also after NULL:
// the job waits for it.
const SbDesignAnswer *sb_design_page_answer(SbDesignPage *page);

// Ends the use of sb_design_page_answer().
void sb_design_page_release(SbDesignPage *page);

// Shows `text`, a translated sentence, in the line of messages; "": none. It is copied.
void sb_design_page_say(SbDesignPage *page, const char *text);

// Draws the map, the effects of tolerances and the drawn valves again, soon.
void sb_design_page_redraw(SbDesignPage *page);

// Updates all widgets except those of sb_design_page_show_form(), and draws all areas again.
void sb_design_page_refresh(SbDesignPage *page);

// Called after the user changed page->ask: computes the map again if it uses closed forms,
// otherwise ends the running job and states that the map has to be computed again.
void sb_design_page_asked(SbDesignPage *page);

// Appends a button with the translated `label` and tooltip `tip` to `bar` and returns it; `call` is
// its handler of "clicked" with `page` as data.
GtkWidget *sb_design_page_add_button(GtkBox *bar, const char *label, const char *tip,
                                     GCallback call, SbDesignPage *page);

// ---- The form (design_page_form.c) ----

// Appends the choices of the map's two axes and of its lines to `bar`.
void sb_design_page_add_axes(SbDesignPage *page, GtkBox *bar);

// Appends the choices of goal, ranges and models, and the button that writes the best design to the
// document, to `to`.
void sb_design_page_add_question(SbDesignPage *page, GtkBox *to);

// Shows page->ask in the form; no handler changes page->ask meanwhile.
void sb_design_page_show_form(SbDesignPage *page);

// ---- The map (design_page_map.c) ----

// Connects pointer and keys of the map's drawing area.
void sb_design_page_listen(SbDesignPage *page, GtkWidget *map);

// Appends the line of the picked point with its buttons, and the line of models, to `to`.
void sb_design_page_add_picked(SbDesignPage *page, GtkBox *to);

// Returns values and figures of the picked point of `answer` (NULL: no results) as a sentence, or
// how a point is picked. Freed with g_free().
char *sb_design_page_picked_text(const SbDesignPage *page, const SbDesignAnswer *answer);

// Returns which models the map uses and, if both are known, its figures at the present design with
// those of the displayed run. `answer` NULL: no results. Freed with g_free().
char *sb_design_page_models_text(SbDesignPage *page, const SbDesignAnswer *answer);
