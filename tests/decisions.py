#!/usr/bin/python3
"""No code decides by text: by a figure's path, a parameter's key, the name of a view, a column that
has an enumeration next to it, the text of a message, or the code of a warning. The catalogues have
enumerations for the names, and their readers alone compare their strings.

decisions.py SOURCE, TAP on standard output.
"""
import os
import re
import sys

COMPARE = re.compile(r'\b(strn?cmp|strstr|strn?casecmp|g_strcmp0|g_str_equal|g_str_has_prefix|'
                     r'g_str_has_suffix|g_strrstr|g_ascii_strn?casecmp)\(')
STRING = re.compile(r'"((?:[^"\\]|\\.)*)"')
# Readers of the catalogues.
READERS = {'engine/valve/model/params.c', 'engine/valve/model/param_equation.c',
           'engine/valve/figures/figures.c'}
# (file, text of the call): why text is compared there.
ALLOWED = {
    ('app/document/document_parts.c', 'g_str_has_prefix(group, "part.")'): 'group of a file',
    ('app/export/thesis_results.c', 'strstr(reason, "(sealbench ")'): 'text of a study file',
    ('app/export/thesis_results.c', 'strstr(reason, "(meson test ")'): 'text of a study file',
    ('engine/valve/studies/study_stribeck.c', 'strcmp(warning->code, "film-speed")'):
        'the sentence of the run is that of the gap',
    ('app/cli/cli.c', 'strstr(message, "--")'): 'GLib names an unknown option in its message only',
    ('app/cli/command_check.c', 'strstr(error->message, ": ")'):
        'removes the file that begins the message, which the issue names itself',
}
COLUMN = re.compile(r'\b(?:figure|row|param|column|axis|series|view|sb_(?:figure|param)\([^)]*\))'
                    r'(?:\[\w+\])?(?:->|\.)(?:path|key|si|shown|unit|tag|where|name|quantity|view)\b|'
                    r'\brequest(?:->|\.)view\b')
MESSAGE = re.compile(r'(?:->|\.)(?:text|message)\b(?!\[)|'
                     r'\bsb_\w*(?:reason|error|failure)\(|^\s*(?:why|reason|cause|message)\b')

CODE = re.compile(r'(?:->|\.)code\b')


def catalogue(source):
    """Names of figures and parameters, and the beginnings and endings by which code could find them."""
    found = set()
    for name in ('engine/valve/figures/figures.def', 'engine/valve/model/params.def'):
        with open(os.path.join(source, name), encoding='utf-8') as file:
            text = re.sub(r'//.*', '', file.read())
        found |= {s for s in STRING.findall(text) if re.fullmatch(r'[a-z]\w*(?:\.\w+)+', s)}
        # Rows of seals, contacts and storage name the last part alone.
        found |= {'seals.outer.' + s for s in
                  re.findall(r'SB_(?:SEAL|SEAL_FIGURE|CONTACT_FIGURE|SHELF)\((?:\w+, \w+, \w+, )?"([\w.]+)"', text)}
    parts = set(found)
    for name in found:
        words = name.split('.')
        for i in range(1, len(words)):
            parts.add('.'.join(words[:i]) + '.')
            parts.add('.' + '.'.join(words[i:]))
            parts.add('.' + words[i - 1] + '.')
        parts |= {'_' + word for word in words[-1].split('_')[1:]}
    return parts


def arguments(text, start):
    """The arguments of the call whose parenthesis opens before `start`."""
    depth, quoted, at, begin, found = 1, False, start, start, []
    while depth > 0 and at < len(text):
        c = text[at]
        if quoted:
            at += c == '\\'
            quoted = c != '"'
        elif c == '"':
            quoted = True
        elif c == "'":
            at += 3 if text[at + 1] == '\\' else 2
        elif c in '([{':
            depth += 1
        elif c in ')]}':
            depth -= 1
        if depth == 0 or (depth == 1 and c == ',' and not quoted):
            found.append(' '.join(text[begin:at].split()))
            begin = at + 1
        at += 1
    return found


def decisions(text, names):
    """(call, reason) of all comparisons with a literal that decide by text of our own."""
    text = re.sub(r'//[^\n]*', '', text)
    for call in COMPARE.finditer(text):
        own = arguments(text, call.end())
        literals = [s for argument in own for s in STRING.findall(argument)]
        what = call.group(1) + '(' + ', '.join(own) + ')'
        if not literals:
            continue
        if any(literal in names for literal in literals):
            yield what, 'a path or a key'
        elif any(COLUMN.search(argument) for argument in own) and literals != ['1']:
            yield what, 'a column'
        elif any(MESSAGE.search(argument) for argument in own):
            yield what, 'a message'
        elif any(CODE.search(argument) for argument in own):
            yield what, 'a code of a warning'


def decisions_in(source, names):
    found, allowed = [], set()
    for layer in ('engine', 'app', 'ui'):
        for folder, _, files in os.walk(os.path.join(source, layer)):
            for file in sorted(files):
                path = os.path.relpath(os.path.join(folder, file), source)
                if not file.endswith(('.c', '.h')) or path in READERS:
                    continue
                with open(os.path.join(source, path), encoding='utf-8') as stream:
                    for what, reason in decisions(stream.read(), names):
                        if (path, what) in ALLOWED:
                            allowed.add((path, what))
                        else:
                            found.append(f'{path}: {what} ({reason})')
    return found, [f'{path}: {what}' for path, what in ALLOWED if (path, what) not in allowed]


# Lines of earlier code, each of which must be found.
EARLIER = [
    'if (strcmp(own->parameter, "canister.pressure") != 0) {',
    'strncmp(cause.text, "film: ", 6) == 0',
    'passed = strcmp(own.parameter, "gasket.crimp") == 0;',
    'from.tag == NULL || strcmp(row->tag, "typical") != 0',
    'if (g_str_has_prefix(error->message, "the value is not finite")) {',
    'g_str_has_prefix(why, "there is no other value")',
    'strstr(sb_session_error(session, (SbParamId)wrong), "out of range") != NULL',
    'if (!g_str_has_prefix(sb_figure(i)->path, "solver.")) {',
    'g_str_has_prefix(figure->path, "seals.outer.")',
    'if (g_str_has_suffix(path, ".lambda")) {',
    'strstr(param->key, ".outer.") != NULL ? "outer" : "inner"',
    'g_str_has_suffix(sb_param(id)->key, "_tolerance")',
    'begins = g_str_has_prefix(key, "models.");',
    'bool noise = strcmp(figure->si, "N") == 0;',
    'bool difference = strstr(column->name, "against") != NULL;',
    'if (strcmp(view->name, "dashboard") == 0) {',
    'if (strcmp(job->request.view, "report") == 0) {',
    'if (strcmp(out->warnings.item[i].code, "no-contact") != 0) {',
    'if (g_str_has_prefix(study->warnings.item[i].code, "study-gap-")) {',
]
# Lines that read the user's text.
READING = [
    'if (strcmp(entry->name, "method") == 0) {',
    'const bool stream = strcmp(path, "-") == 0;',
    'strcmp(param->si, "1") != 0',
    'if (g_str_has_prefix(text, ">=")) {',
]

source = sys.argv[1]
names = catalogue(source)
found, unused = decisions_in(source, names)
checks = [
    ('no code decides by text of our own', found),
    ('every exception is used', unused),
    ('each earlier decision by text is found',
     [line for line in EARLIER if len(list(decisions(line, names))) != 1]),
    ('a comparison with the text of a user is none', [line for line in READING if list(decisions(line, names))]),
]
print(f'1..{len(checks)}')
for number, (name, wrong) in enumerate(checks, 1):
    print(f'{"not ok" if wrong else "ok"} {number} {name}')
    for line in wrong:
        print('#', line)
sys.exit(any(wrong for _, wrong in checks))
