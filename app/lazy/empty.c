// A library without code, whose needed libraries stubs.py reads. ISO C requires one declaration.
extern int sb_lazy_empty;
