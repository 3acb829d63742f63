#!/usr/bin/env python3
"""Writes a header with the hash of the engine's sources and of what they are compiled with, and the
list of those sources for the build: source_hash.py OUTPUT DEPFILE ENGINE WORD... A result kept by a
program whose engine has the same hash is one that this program would compute itself."""
import hashlib
import os
import sys

output, depfile, engine, *words = sys.argv[1:]
sources = sorted(os.path.join(folder, name) for folder, _, names in os.walk(engine) for name in names
                 if name.endswith(('.c', '.h', '.def')))
total = hashlib.sha256('\n'.join(words).encode())
for path in sources:
    with open(path, 'rb') as file:
        total.update(os.path.relpath(path, engine).encode() + b'\0')
        total.update(hashlib.sha256(file.read()).digest())
with open(output, 'w', encoding='utf-8') as file:
    file.write('#define SB_SOURCE_HASH "%s"\n' % total.hexdigest())
with open(depfile, 'w', encoding='utf-8') as file:
    file.write('%s: %s\n' % (output, ' '.join(path.replace(' ', '\\ ') for path in sources)))
