#!/usr/bin/env python3
"""Writes the header with the identity of the engine, and the list of the files that it depends on:

identity.py OUTPUT DEPFILE SOURCE VERSION WORD...

VERSION is the release, the words name what compiles the engine. SB_SOURCE_HASH covers the engine's
sources and the words: two programs of equal hash compute the same answers. SB_COMMIT is the commit of
the repository at SOURCE, NULL where SOURCE is not the root of a repository."""
import hashlib
import os
import sys


def read(path):
    """The text of a file of git, empty if it is not there."""
    try:
        with open(path, encoding='utf-8') as file:
            return file.read().strip()
    except OSError:
        return ''


def find_commit(source):
    """The commit checked out, or None, and the files that change with it. Reads git's own files: git
    itself need not be installed, and refuses a folder of another user."""
    own = os.path.join(source, '.git')
    if os.path.isfile(own):  # a second work tree
        own = os.path.join(source, read(own).removeprefix('gitdir: '))
    common = os.path.join(own, read(os.path.join(own, 'commondir')))
    head = read(os.path.join(own, 'HEAD'))
    commit, used = head, [os.path.join(own, 'HEAD'), os.path.join(own, 'logs/HEAD')]
    if head.startswith('ref: '):
        name = head[5:]
        used += [os.path.join(common, name), os.path.join(common, 'packed-refs')]
        packed = (line.split() for line in read(used[-1]).splitlines())
        commit = read(used[-2]) or next((words[0] for words in packed if words[1:] == [name]), '')
    hexadecimal = len(commit) in (40, 64) and set(commit) <= set('0123456789abcdef')
    return commit if hexadecimal else None, [path for path in used if os.path.isfile(path)]


output, depfile, source, version, *words = sys.argv[1:]
engine = os.path.join(source, 'engine')
sources = sorted(os.path.join(folder, name) for folder, _, names in os.walk(engine) for name in names
                 if name.endswith(('.c', '.h', '.def')))
total = hashlib.sha256('\n'.join(words).encode())
for path in sources:
    with open(path, 'rb') as file:
        total.update(os.path.relpath(path, engine).encode() + b'\0')
        total.update(hashlib.sha256(file.read()).digest())
commit, used = find_commit(source)


def quote(text):
    return '"%s"' % text.replace('\\', '\\\\').replace('"', '\\"')


with open(output, 'w', encoding='utf-8') as file:
    file.write('#define SB_VERSION %s\n#define SB_SOURCE_HASH %s\n#define SB_COMMIT %s\n'
               '#define SB_OPTIONS %s\n' % (quote(version), quote(total.hexdigest()),
                                            quote(commit) if commit else 'NULL',
                                            quote(' '.join(words))))
with open(depfile, 'w', encoding='utf-8') as file:
    file.write('%s: %s\n' % (output, ' '.join(path.replace(' ', '\\ ') for path in sources + used)))
