#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes one file that compiles unit tests together, each in a namespace of its
own, so that their helpers may have names in common: the headers of all come
first, outside of the namespaces.

unit_module.py OUTPUT TEST ...
"""
import os
import re
import sys


def main():
    headers, bodies = {}, []
    for path in sys.argv[2:]:
        with open(path) as stream:
            text = stream.read()
        for header in re.findall(r'^#include ([<"].*[>"])', text, re.MULTILINE):
            if header.startswith('"'):
                header = '"%s"' % os.path.normpath(os.path.join(
                    os.path.dirname(path), header.strip('"')))
            headers[header] = None
        body = '#include "%s"\n' % path
        # those that open the program's own namespace need none around it
        if not re.search(r"^namespace quoin", text, re.MULTILINE):
            name = os.path.splitext(os.path.basename(path))[0]
            body = "namespace %s\n{\n%s}\n" % (name, body)
        bodies.append(body)
    with open(sys.argv[1], "w") as stream:
        stream.writelines("#include %s\n" % header for header in headers)
        # Fixtures are in unnamed namespaces of the files that follow.
        stream.write('#pragma GCC diagnostic ignored "-Wsubobject-linkage"\n')
        stream.writelines(bodies)


if __name__ == "__main__":
    main()
