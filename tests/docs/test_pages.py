#!/usr/bin/python3
"""The test of the documentation (pages.py) itself: what it must find, and the pages without a test of their own.

    test_pages.py SOURCE BUILD PAGE...          the pages that meson.build registered
"""
import os
import re
import subprocess
import sys
import tempfile

import pages

# Name: a page, and whether each of its commands passes.
CASES = {
    'output': ('''
```sh
echo first
printf '1.61 mm\\n2 N\\n3 N\\n4 N\\n'
```
```text
2 N
...
4 N
```
''', [True, True]),
    'a wrong figure': ('''
```sh
printf '1.61 mm\\n'
```
```text
1.62 mm
```
''', [False]),
    'lines that are apart': ('''
```sh
printf '1\\n2\\n3\\n'
```

```text
1
3
```
''', [False]),
    'lines in another order': ('''
```sh
printf '1\\n2\\n3\\n'
```
```text
3
...
1
```
''', [False]),
    'a wrong figure of the program': ('''
```sh
sealbench asperity --lambda 0.5 | grep F2
```
```text
  F2                                   9.9999
```
''', [False]),
    'an exit code': ('```sh\nfalse\n\n# a comment\ntrue\n```\n', [False, True]),
    'an error that is shown': ('''
```sh
sealbench run no-such-scene
```
```text
sealbench: no-such-scene: No such file or directory
```
''', [True]),
    'an error that is not shown': ('```sh\nsealbench run no-such-scene\n```\n', [False]),
    'an error that does not occur': ('''
```sh
sealbench list views | tail -1; echo 'sealbench: oh'
```
```text
sealbench: something else
```
''', [False]),
    'continued lines and the state of the shell': ('''
```sh
mkdir sub && cd sub
export KEY=value
echo $KEY \\
  more
```
```text
value more
```

```sh
basename "$PWD"
cat <<END
$KEY
END
```
```text
value
```
''', [True] * 5),
    'files': ('''
```ini
# my.scene
[sealbench]
format = 1
kind = scene
valve = assets/valves/piston.valve
```

```sh
sealbench check my.scene
sealbench check assets/scenes/quick-look.scene
build/sealbench check my.scene
```
''', [True] * 4),
    'a file with a fault': ('```ini\n# my.scene\n[sealbench]\nformat = 1\nkind = scene\nvalve = no\n```\n', [False]),
    'a file without a name': ('```ini\n[seal]\n```\n', [False]),
    'figures in sentences': ('''
A film of 1 at 0.5. <!-- sealbench asperity --lambda 0.5
prints 0.20963926002533384; 0.5 -->

It is 0.20963926002533384. <!-- sealbench asperity --lambda 0.5 prints 0.3 -->
<!-- sealbench asperity --lambda 0.5 prints F2 -->
''', [True, False, False]),
    'figures that are printed': ('''
It is 0.20963926002533384. <!-- sealbench asperity --lambda 0.5 prints 0.20963926002533384 -->
''', [True]),
    'times and dates': ('''
```sh
echo "2026-11-28: computed in 1.5 s, 3 N, source 0123456789abcdef"
```
```text
2025-01-01: computed in 22 s, 3 N, source fedcba9876543210
```
''', [True]),
    'rounding': ('''
```sh
echo "error 4e-06 % ± 2e-07 pl, 0.07533978334377073, 6.85e-10 m"
```
```text
error 5e-08 % ± 1e-09 pl, 0.07533978311111111, 6.85e-10 m
```
```sh
echo 6.85e-10
```
```text
6.86e-10
```
```sh
echo 0.07533978334377073
```
```text
0.07533988334377073
```
''', [True, False, False]),
    'python': ('''
```python
print(1.5)
```
```text
2.5
```

```python
import sealbench
print(sealbench.Scene("assets/scenes/quick-look.scene")["seal.section_diameter"])
```
''', [False, True]),
    'python that fails': ('```python\nraise SystemExit("no")\n```\n', [False]),
    'c': ('''
```c
#include <sealbench.h>
int main(void) { return no_such_name; }
```

```c
#include <stdio.h>
int main(void) { return puts("2.5 N") < 0; }
```
```text
2.5 N
```

```c
int part_of_a_program;
```
''', [False, True]),
    'in sentences': ('''
`sealbench list views` and `sealbench run`, `sealbench rum`, `sealbench run FILE.scene -o DIR --all-of-it`,
`sealbench run FILE.scene -o DIR --json FILE`, `sealbench check
no.scene`, `sealbench thesis table-7.5` and `sealbench thesis table-7.99`, `meson test docs-selftest`,
`meson test docs-no-such-test`, and `my sealbench`.
''', [True, True, False, False, True, False, True, False, True, False]),
    'names': ('`params.def`, `no_such_file.c`, campaigns `thesis` and campaign `no-such`.\n', [False, False]),
    'links': ('''
# A heading, with 2 words
[one](page.md#a-heading-with-2-words) [two](#a-heading) [three](assets/valves/piston.valve) [four](no.md)
[five](https://example.org/)
''', [False, False]),
    'windows and terminals': ('```sh\nsealbench-gtk no.scene\nsealbench tui no.scene\nsealbench tui quick-look\n```\n',
                              [False, False, True]),
    'skipped': ('```sh\n./run\nKEY=1 sudo rm -rf /\nmeson setup build\n```\n', [True] * 3),
    'other blocks': ('''
~~~sh
true
~~~

- in a list
  ```sh title
  false
  ```

```console
$ sealbench run quick-look
```

    sealbench run quick-look
''', [False, True, False, False]),
    'blocks': ('```\nx\n```\n\n```text\nx\n```\n\n```plain\nx\n```\n\n```sh\ntrue', [False, False, False, True]),
}


def make_source(source, folder):
    for name in ('assets', 'bindings', 'engine', 'include', 'tests'):
        os.symlink(os.path.join(source, name), os.path.join(folder, name))


def run(folder, build, text, *options):
    """Whether each command of a page passes, the page afterwards, and what was printed."""
    path = os.path.join(folder, 'page.md')
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)
    done = subprocess.run([sys.executable, pages.__file__, *options, folder, build, 'page.md'],
                          capture_output=True, text=True, check=False)
    lines = [line for line in done.stdout.split('\n') if re.match(r'(not )?ok \d+ - page.md:[1-9]', line)]
    with open(path, encoding='utf-8') as file:
        return [line.startswith('ok') for line in lines], file.read(), done.stdout + done.stderr


def rewrites(folder, build):
    before = '''
```sh
printf 'Load 14.78 N\\nForce 3.1 N\\nWork 2 J\\n'
```
```text
Load 15 N
...
Work 3 J
```
```sh
echo 7
```
```text
```
'''
    after = before.replace('Load 15 N', 'Load 14.78 N').replace('Work 3 J', 'Work 2 J')
    after = after.replace('```text\n```', '```text\n7\n```')
    passed, text, printed = run(folder, build, before, '--rewrite')
    return passed == [True, True] and text == after, text + printed


def main():
    source, build, registered = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3:]
    count = 0

    def report(good, name, why):
        nonlocal count
        count += 1
        print('%sok %d - %s' % ('' if good else 'not ', count, name))
        if not good:
            print('# ' + why.replace('\n', '\n# '))

    with tempfile.TemporaryDirectory() as folder:
        make_source(source, folder)
        for name, (text, expected) in CASES.items():
            passed, _, printed = run(folder, build, text)
            report(passed == expected, name, '%s, expected %s\n%s' % (passed, expected, printed))
        report(*rewrites(folder, build)[:1], 'rewrite', rewrites(folder, build)[1])
    # Pages that are newer than the build's configuration have no test of their own yet.
    for page in sorted(set(pages.pages(source)) - set(registered)):
        done = subprocess.run([sys.executable, pages.__file__, source, build, page], capture_output=True, text=True,
                              check=False)
        report(done.returncode == 0, page, done.stdout + done.stderr)
    print('1..%d' % count)


main()
