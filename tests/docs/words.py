#!/usr/bin/python3
"""The text of README.md and docs/: no words that the project does not use, and the length of the README.

    words.py SOURCE

Words are searched without regard to case, outside of blocks and of code within sentences.
"""
import glob
import os
import re
import sys

WORDS = re.compile(r'\b(hangs?\s+on|told|tells|anew|nobody|somebody|alike|given\s+up|let\s+go|at\s+once|goes\s+with|'
                   r'belongs\s+with|beside|borne|is\s+no\s+[a-z]+|of\s+what|the\s+same\s+of|make\s+no)\b', re.I)
README_LINES = 120


def blank(match):
    """As many lines as before, without their text."""
    return re.sub(r'[^\n]', ' ', match.group())


def prose(text):
    """The text without blocks and without code within sentences; lines stay."""
    text = re.sub(r'^ *```.*?^ *```[^\n]*$', blank, text, flags=re.M | re.S)
    return re.sub(r'(`+)(?!`).+?(?<!`)\1(?!`)', blank, text, flags=re.S)


def unwanted(text):
    """(line, words) of everything that a page should not have."""
    return [(text.count('\n', 0, found.start()) + 1, ' '.join(found.group().split()))
            for found in WORDS.finditer(prose(text))]


def check_itself():
    """Examples that must be found, and others that must not."""
    for text in ['It hangs\non the load.', 'Nobody knows.', 'This is no study.', 'A ring Beside a bore.', 'the same\nof both',
                 'at once', 'x\n```sh\na\n```\nanew', '| told | a |', 'a *given up* run', '`a` tells `b`']:
        if len(unwanted(text)) != 1:
            return f'{text!r} should have one finding'
    for text in ['`is no study`', '```text\nanew\n```', 'a `beside`d', '  ```text\n  told\n  ```', 'alikeness, retold, nobodys',
                 'This is not a study.', '``a ` told``', 'between `a` and `told\nb`']:
        if unwanted(text):
            return f'{text!r} should have no finding'
    return ''


def main():
    source = sys.argv[1]
    pages = ['README.md'] + sorted(os.path.relpath(path, source) for path in
                                   glob.glob(os.path.join(source, 'docs', '**', '*.md'), recursive=True))
    print(f'1..{len(pages) + 2}')
    number, failed = 0, 0

    def result(what, problem):
        nonlocal number, failed
        number += 1
        failed += bool(problem)
        print(f'{"not ok" if problem else "ok"} {number} - {what}')
        for line in problem.splitlines():
            print('# ' + line)

    result('the test itself', check_itself())
    for page in pages:
        with open(os.path.join(source, page), encoding='utf-8') as file:
            text = file.read()
        problems = [f'{page}:{line}: "{words}"' for line, words in unwanted(text)]
        result(page, '\n'.join(problems))
        if page == 'README.md':
            lines = text.count('\n')
            result(f'README.md has at most {README_LINES} lines', '' if lines <= README_LINES else f'{lines} lines')
    return failed


if __name__ == '__main__':
    sys.exit(1 if main() else 0)
