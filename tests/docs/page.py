"""A page of the documentation: its blocks and commands, and the comparison of an output with a block."""
import re

PROGRAM = re.compile(r'(?:\./)?(?:build/)?(?:ui/)?(sealbench(?:-gtk)?)(?=\s|$)')

# What depends on the moment and the machine: dates, hashes, versions, times of the program, rounding.
MASKS = [
    (re.compile(r'\d{4}-\d\d-\d\d([T ]\d\d:\d\d(:\d\d)?)?'), 'DATE'),
    (re.compile(r'\b(?=\d*[a-f])[0-9a-f]{12,}\b'), 'HASH'),
    (re.compile(r'\b\d+\.\d+\.\d+(\S*)?'), 'VERSION'),
    (re.compile(r'\b(in|took|after) [\d.]+ (ms|s|min)\b'), 'TIME'),
    # Errors of rounding, and digits beyond those on which processors agree.
    (re.compile(r'(error[^\d\n]*|± )[\d.]+e-\d+'), r'\1TINY'),
    (re.compile(r'(\d\.\d{9})\d+'), r'\1'),
    (re.compile(r'"wall_s": [\d.e-]+'), '"wall_s": TIME'),
    (re.compile(r'/\S*/(assets|share/sealbench)/'), 'ASSETS/'),
]


class Page:
    """Blocks and commands within sentences of a page, in order: (kind, line, text)."""

    def __init__(self, path):
        with open(path, encoding='utf-8') as file:
            self.lines = file.read().split('\n')
        self.items, self.faults, self.text = [], [], ''
        prose, at = [], 0
        while at < len(self.lines):
            fence = re.match(r'\s*(```|~~~)[`~]*\s*([^`\s]*)[^`]*$', self.lines[at])
            if fence is None:
                if re.match(r'(\t| {4,})\S*sealbench\b', self.lines[at]):
                    self.faults.append((at + 1, 'a command outside of a block: ```sh'))
                prose.append((at, self.lines[at]))
                at += 1
                continue
            self.take_prose(prose)
            prose, begin = [], at + 1
            at = begin
            while at < len(self.lines) and not re.match(r'\s*%s+\s*$' % fence.group(1), self.lines[at]):
                at += 1
            if at == len(self.lines):
                self.faults.append((begin, 'a block that does not end'))
            if fence.group(2) == '':
                self.faults.append((begin, 'a block without a language (sh, text, plain, ...)'))
            self.items.append((fence.group(2), begin, self.lines[begin:at]))
            at += 1
        self.take_prose(prose)

    def take_prose(self, prose):
        text, places = '', []
        for at, line in prose:
            places.append((len(text), at + 1))
            text += line + '\n'
        for quoted in re.finditer(r'<!--\s*(sealbench\s.*?)\sprints\s(.*?)-->', text, re.DOTALL):
            line = max(at for begin, at in places if begin <= quoted.start())
            figures = [' '.join(each.split()) for each in quoted.group(2).split(';')]
            self.items.append(('quoted', line, (' '.join(quoted.group(1).split()), figures)))
        text = re.sub(r'<!--.*?-->', lambda comment: re.sub(r'[^\n]', ' ', comment.group()), text,
                      flags=re.DOTALL)
        self.text += ' '.join(text.split()) + '\n'
        for span in re.finditer(r'(?<!`)`([^`]+)`(?!`)', text):
            line = max(at for begin, at in places if begin <= span.start())
            code = ' '.join(span.group(1).split())
            if PROGRAM.match(code) and '/' not in code.split()[0].replace('build/', '').replace('ui/', ''):
                self.items.append(('inline', line, code))
            elif code.startswith('meson test '):
                self.items.append(('tests', line, code))
            elif re.fullmatch(r'[\w./-]+\.(c|h|py|def)', code):
                self.items.append(('source', line, code))
            elif re.search(r'campaigns?\s$', text[:span.start()]):
                self.items.append(('campaign', line, code))
        for link in re.finditer(r'\]\(([^)\s]+)\)', text):
            if not re.match(r'[a-z]+:', link.group(1)):
                line = max(at for begin, at in places if begin <= link.start())
                self.items.append(('link', line, link.group(1)))
        # Text between blocks separates an output from its command.
        if text.strip():
            self.items.append(('prose', 0, ''))


def masked(line):
    for pattern, replacement in MASKS:
        line = pattern.sub(replacement, line)
    return ' '.join(line.split())


def find_run(expected, lines, start):
    """First index from `start` at which the lines are found one after another; -1 if none."""
    for at in range(start, len(lines) - len(expected) + 1):
        if lines[at:at + len(expected)] == expected:
            return at
    return -1


def difference(expected, output):
    """None if the text is an excerpt of the output, else what is missing."""
    lines, at, run = [masked(line) for line in output], 0, []
    for line in [*expected, '...']:
        if line.strip() != '...':
            run.append(masked(line))
            continue
        found = find_run(run, lines, at)
        if found < 0:
            # The line that is missing, or the run whose lines are there but apart.
            wrong = next((one for one in run if one not in lines[at:]), ' / '.join(run))
            return 'not in the output: %s' % wrong
        at, run = found + len(run), []
    return None


def skeleton(line):
    return ' '.join(re.sub(r'[-+−]?\d[\d.,]*(e[-+]?\d+)?', '#', masked(line)).split())


def rewritten(expected, output):
    """The text with the output's lines that differ from its own in figures only."""
    if not any(line.strip() for line in expected):
        return output
    at, result = 0, []
    for line in expected:
        found = next((i for i in range(at, len(output)) if skeleton(output[i]) == skeleton(line)), None)
        if line.strip() != '...' and found is not None:
            line, at = output[found].rstrip(), found + 1
        result.append(line)
    return result
