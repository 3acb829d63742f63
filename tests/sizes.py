#!/usr/bin/python3
"""Functions and files stay short. A function above 60 lines, and a file above 500, states why it is one piece:
its head has a comment "// Long: reason". Such functions and files are few.

sizes.py SOURCE, TAP on standard output.
"""
import os
import re
import sys

LINES_OF_FUNCTION, LINES_OF_FILE = 60, 500
FUNCTIONS_MAX, FILES_MAX = 20, 10
REASON = re.compile(r'^// Long: \S.{9,}')
# The formatter puts a function's name in the first column and its braces at the end of a line and in the first
# column. A structure, an enumeration and an initialiser have no parenthesis before the brace.
BEGIN = re.compile(r'^[A-Za-z_][^;={]*\(')


def head_of(lines, end):
    """The comment that ends before a line."""
    begin = end
    while begin > 0 and lines[begin - 1].startswith('//'):
        begin -= 1
    return lines[begin:end]


def functions(lines):
    """(line, number of lines, lines of the comment above) of all functions of a file, lines counted from 0."""
    begin = None
    for number, line in enumerate(lines):
        if begin is None and BEGIN.match(line):
            begin = number
        if begin is not None and line.endswith(';') and not any('{' in other for other in lines[begin:number + 1]):
            begin = None  # a declaration
        if line.endswith('{}'):
            begin = None
        if line.startswith('}'):
            if begin is not None:
                yield begin, number - begin + 1, head_of(lines, begin)
            begin = None


def has_reason(head):
    return any(REASON.match(line) for line in head)


def look_at(path, text):
    """Long functions and files as (place, whether it states a reason), and reasons of what is not long."""
    lines = text.split('\n')[:-1]
    end = next((number for number, line in enumerate(lines) if not line.startswith('//')), len(lines))
    long_functions, spare = [], []
    for begin, count, head in functions(lines):
        place = f'{path}:{begin + 1}: {count} lines'
        if count > LINES_OF_FUNCTION:
            long_functions.append((place, has_reason(head)))
        elif has_reason(head):
            spare.append(place)
    file = (f'{path}: {len(lines)} lines', has_reason(lines[:end]))
    long_file = len(lines) > LINES_OF_FILE
    if file[1] and not long_file:
        spare.append(file[0])
    return long_functions, [file] if long_file else [], spare


def without(found):
    return [place for place, reason in found if not reason]


def at_most(found, most):
    return [] if len(found) <= most else [f'{len(found)}, at most {most}:'] + [place for place, _ in found]


def self_test():
    """Texts that look_at() judges wrongly."""
    def function(lines, head=''):
        return f'{head}static int name(int a,\n                int b) {{\n' + '  a++;\n' * (lines - 3) + '}\n'
    reason, wrong = '// Long: one table of cases.\n', []
    long_one, short = function(LINES_OF_FUNCTION + 1), function(LINES_OF_FUNCTION)
    for name, text, expected in [
            ('a long function', long_one, (1, 0, 0)),
            ('one after a declaration', 'int before(int a);\n' + long_one, (1, 0, 0)),
            ('one after a table', 'static const int table[] = {\n  1,\n};\n' + long_one, (1, 0, 0)),
            ('a short one after an empty one', 'static void none(void) {}\n' + short, (0, 0, 0)),
            ('one with a label', long_one.replace('  a++;\n', 'again:\n', 1), (1, 0, 0)),
            ('a short function', short + short, (0, 0, 0)),
            ('a long table', 'static const int table[] = {\n' + '  1,\n' * 99 + '};\n', (0, 0, 0)),
            ('a long function with a reason', '\n' + reason + long_one, (0, 0, 0)),
            ('a reason without words', '\n// Long:\n' + long_one, (1, 0, 0)),
            ('a reason in the body', long_one.replace('  a++;\n', reason, 1), (1, 0, 0)),
            ('a reason of a short function', '\n' + reason + short, (0, 0, 1)),
            ('a long file', '// Head.\n' + '\n' * LINES_OF_FILE, (0, 1, 0)),
            ('a long file with a reason', '// Head.\n' + reason + '\n' * LINES_OF_FILE, (0, 0, 0)),
            ('a reason of a short file', '// Head.\n' + reason + '\n', (0, 0, 1))]:
        of_functions, of_files, spare = look_at('file.c', text)
        if (len(without(of_functions)), len(without(of_files)), len(spare)) != expected:
            wrong.append(name)
    if not at_most([('a', True)] * 3, 2) or at_most([('a', True)] * 2, 2):
        wrong.append('a limit')
    return wrong


source = sys.argv[1]
long_functions, long_files, spare_reasons = [], [], []
for layer in ('engine', 'app', 'ui'):
    for folder, _, names in os.walk(os.path.join(source, layer)):
        for name in sorted(names):
            if name.endswith(('.c', '.h', '.def')):
                with open(os.path.join(folder, name), encoding='utf-8') as stream:
                    result = look_at(os.path.relpath(os.path.join(folder, name), source), stream.read())
                for all_of_them, found in zip((long_functions, long_files, spare_reasons), result):
                    all_of_them += found
checks = [
    (f'a function above {LINES_OF_FUNCTION} lines has a reason (// Long: ...) in its head', without(long_functions)),
    (f'at most {FUNCTIONS_MAX} functions are above {LINES_OF_FUNCTION} lines', at_most(long_functions, FUNCTIONS_MAX)),
    (f'a file above {LINES_OF_FILE} lines has a reason (// Long: ...) in its head', without(long_files)),
    (f'at most {FILES_MAX} files are above {LINES_OF_FILE} lines', at_most(long_files, FILES_MAX)),
    ('every reason is of a long function or file', spare_reasons),
    ('the test finds what is long', self_test()),
]
print(f'1..{len(checks)}')
for number, (name, wrong) in enumerate(checks, 1):
    print(f'{"not ok" if wrong else "ok"} {number} {name}')
    for line in wrong:
        print('#', line)
sys.exit(any(wrong for _, wrong in checks))
