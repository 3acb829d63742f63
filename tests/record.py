#!/usr/bin/python3
"""tools/record: equal runs give equal records, and a record with one byte changed is reported.

record.py SOURCE BUILD, TAP on standard output.
"""
import os
import subprocess
import sys
import tempfile

source, build = sys.argv[1:]
tool = os.path.join(source, 'tools', 'record')


def record(*arguments):
    return subprocess.run([sys.executable, tool, *arguments], capture_output=True, text=True, check=False)


def main():
    with tempfile.TemporaryDirectory() as home:
        one, other = home + '/one', home + '/other'
        made = [record('make', build, folder, '--only', '^(asperity|plan/quick-look|run/quick-look|library/quick-look)$')
                for folder in (one, other)]
        same = record('compare', one, other)
        # A plan states its cost and the engine's source, a run its time; none of them may remain.
        with open(one + '/plan/quick-look/plan.json', encoding='utf-8') as file:
            plan = file.read()
        with open(one + '/run/quick-look/stdout.txt', encoding='utf-8') as file:
            table = file.read()
        path = other + '/library/quick-look/stdout.txt'
        with open(path, 'rb+') as file:
            byte = file.read(1)
            file.seek(0)
            file.write(bytes([byte[0] ^ 1]))
        changed = record('compare', one, other)
        os.remove(other + '/asperity/asperity.json')
        missing = record('compare', one, other)
    return [
        ('four items are recorded', all(run.returncode == 0 for run in made), made),
        ('two runs give equal records', same.returncode == 0 and '0 of ' in same.stdout, same),
        ('times and identity are left out', '"cost_s": *' in plan and '"engine": *' in plan
         and 'Engine time                          *' in table, plan[:300]),
        ('one byte that differs is reported with its file',
         changed.returncode == 1 and 'library/quick-look/stdout.txt: 1 lines differ' in changed.stdout, changed),
        ('a file that is missing is reported', 'asperity/asperity.json: only in' in missing.stdout, missing),
    ]


checks = main()
print(f'1..{len(checks)}')
for number, (name, good, details) in enumerate(checks, 1):
    print(f'{"ok" if good else "not ok"} {number} {name}')
    if not good:
        print('#', str(details).replace('\n', '\n# '))
sys.exit(not all(good for _, good, _ in checks))
