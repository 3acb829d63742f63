#!/usr/bin/python3
"""A source file of app and ui includes what it uses: it compiles by itself, by the flags of its folder,
which the build compiles as one file. TAP on standard output.

includes.py BUILD TURN OF: every OF-th file, from TURN (0 to OF - 1).
"""
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys

build, turn, turns = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])


def rooms():
    """(command without its file, folder, files) of each folder that is compiled as one file."""
    with open(build + '/compile_commands.json', encoding='utf-8') as database:
        for entry in json.load(database):
            path = os.path.join(entry['directory'], entry['file'])
            if not re.search(r'-unity\d+\.c$', path):
                continue
            with open(path, encoding='utf-8') as unity:
                files = re.findall(r'^#include\s*[<"](.*)[>"]', unity.read(), re.M)
            words = shlex.split(entry['command'])
            flags = words[next(i for i, word in enumerate(words) if word.startswith('-')):]
            keep = [word for word in flags if re.match('-(I|isystem|D|std|pthread|W|pedantic)', word)]
            compiler = words[:len(words) - len(flags)]
            # In one file names of two files may shadow each other.
            yield ([*compiler, *keep, '-Wshadow', '-Werror', '-fsyntax-only'], entry['directory'], files)


def compiles(job):
    """What the compiler says of a file, or of a text that it is given; empty if nothing."""
    command, folder, file, text = job
    return subprocess.run([*command, *(['-x', 'c', '-'] if text else [file])], input=text, capture_output=True,
                          text=True, cwd=folder, check=False).stderr


jobs = [(command, folder, file, None) for command, folder, files in rooms() for file in sorted(files)]
assert jobs, 'no folder is compiled as one file'
chosen = jobs[turn::turns]
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    results = [(os.path.relpath(job[2], os.path.join(build, '..')), said == '', said)
               for job, said in zip(chosen, pool.map(compiles, chosen))]
# What it must find.
bare = compiles((*chosen[0][:3], 'int sb_bare(void);\nint sb_bare(void) {\n  return g_strv_length(0) != 0;\n}\n'))
results.append(('a file without its includes is found', 'g_strv_length' in bare, bare))

print(f'1..{len(results)}')
for number, (text, good, said) in enumerate(results, 1):
    print(f'{"ok" if good else "not ok"} {number} {text}')
    if not good:
        print('\n'.join('# ' + line for line in said.splitlines()[:8]))
sys.exit(not all(good for _, good, _ in results))
