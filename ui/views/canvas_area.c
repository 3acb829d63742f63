// Least and natural size of a picture in the window (canvas_area.h).
#include "ui/views/canvas_area.h"

struct _SbCanvasArea {
  GtkDrawingArea parent;
  int least_width, natural_width, least_height, natural_height;
};

G_DEFINE_TYPE(SbCanvasArea, sb_canvas_area, GTK_TYPE_DRAWING_AREA)

static void preferred_width(GtkWidget *widget, int *least, int *natural) {
  SbCanvasArea *area = SB_CANVAS_AREA(widget);
  *least = area->least_width;
  *natural = MAX(area->least_width, area->natural_width);
}

static void preferred_height(GtkWidget *widget, int *least, int *natural) {
  SbCanvasArea *area = SB_CANVAS_AREA(widget);
  *least = area->least_height;
  *natural = MAX(area->least_height, area->natural_height);
}

static void sb_canvas_area_class_init(SbCanvasAreaClass *class) {
  GTK_WIDGET_CLASS(class)->get_preferred_width = preferred_width;
  GTK_WIDGET_CLASS(class)->get_preferred_height = preferred_height;
}

static void sb_canvas_area_init(SbCanvasArea *area) {}

GtkWidget *sb_canvas_area_new(int least_width, int natural_width, int least_height,
                              int natural_height) {
  SbCanvasArea *area = g_object_new(SB_TYPE_CANVAS_AREA, NULL);
  area->least_width = least_width;
  area->natural_width = natural_width;
  area->least_height = least_height;
  area->natural_height = natural_height;
  return GTK_WIDGET(area);
}
