#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""What documents refer to exists:

- relative links of .md files, and the headings behind their #;
- `theory.md, "Loads"`, in documents, sources and scripts: a heading of that
  document, or words in bold at the beginning of a paragraph;
- `[Key]` in theory.md and `@cite Key` in sources: an entry of references.bib.

Sections have numbers only within their document, as in [section 4](#4-loads):
the link shows which one is meant when numbers change. A number without link
is refused, and so are numbers of sections of another document.
"""
import os
import re
import sys

DOCUMENTS = "doc"
ENDS = (".md", ".h", ".cc", ".py", ".prm", ".inc", ".geo", ".json")
LEFT_OUT = {"build", "output"}

LINK = re.compile(r"!?\[([^\]]*)\]\(([^)\s]+)\)")
HEADING = re.compile(r"^(#+) +(.*?)\s*$", re.MULTILINE)
BOLD = re.compile(r"^ *(?:[-*] )?\*\*(.+?)[.:]?\*\*", re.MULTILINE)
# the name may go on in the next line of a comment
NAMED = re.compile(r'(\w+\.md)`?(?:\]\([^)]*\))?,[\s*#/]+"([^"]{1,60})"')
NUMBER = re.compile(r"\bsections?\s+(?:\d+\.?\d*\b)", re.IGNORECASE)
ELSEWHERE = re.compile(r"(?:\b(?:theory|user_guide|developer)(?:\.md)?`?,?\s+"
                       r"\(?(?:sections?\s+)?\d"
                       r"|\bsections?\s+\d+\s+of\s+`?\w+\.md)", re.IGNORECASE)
FENCE = re.compile(r"^( *)```.*?^\1```", re.DOTALL | re.MULTILINE)
CITE = re.compile(r"@cite\s+(?:\*\s+)?([A-Za-z]\w*)")
BRACKETS = re.compile(r"\[((?:[A-Z][A-Za-z]*\d{4}|DLMF)[^\]]*)\](?!\()")


def read(path):
    with open(path, encoding="utf-8") as stream:
        return stream.read()


def files(root):
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders if name not in LEFT_OUT
                            and not name.startswith((".", "build")))
        for name in sorted(names):
            if name.endswith(ENDS):
                yield os.path.join(folder, name)


def blank(match):
    """Replacement of code: dots instead of words, in the same lines."""
    return re.sub(r"[^\n]", ".", match.group(0))


def without_fences(text):
    return FENCE.sub(blank, text)


def prose(text):
    return re.sub(r"`[^`\n]*`", blank, without_fences(text))


def anchors(text):
    """The names that GitHub gives to headings."""
    found = []
    for _, title in HEADING.findall(text):
        name = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
        before = sum(1 for other in found if other == name)
        found.append(name if before == 0 else "%s-%d" % (name, before))
    return set(found)


def titles(text):
    """Titles that may be quoted: headings without their number, words in
    bold."""
    found = {re.sub(r"^\d+\.? ", "", title).replace("`", "")
             for _, title in HEADING.findall(text)}
    return found | {" ".join(words.split()) for words in BOLD.findall(text)}


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def wrong_links(path, text, documents):
    plain = prose(text)
    for match in LINK.finditer(plain):
        target = match.group(2)
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        other = os.path.normpath(
            os.path.join(os.path.dirname(path), name)) if name else path
        if not os.path.exists(other):
            yield match.start(), "no file '%s'" % target
        elif anchor and (other not in documents
                         or anchor not in documents[other]):
            yield match.start(), "no heading '%s'" % target
        number = re.match(r"sections?\s+(\d+)$", match.group(1))
        if number and not anchor.startswith(number.group(1) + "-"):
            yield match.start(), "'%s' leads to '%s'" % (match.group(1),
                                                         target)
    unlinked = LINK.sub(blank, plain)
    for match in NUMBER.finditer(unlinked):
        yield match.start(), "'%s' without a link" % match.group(0)


def wrong_names(text, quotable):
    for match in NAMED.finditer(text):
        name = re.sub(r"\s+(?:[*#/]+\s+)?", " ", match.group(2))
        known = quotable.get(match.group(1))
        if known is not None and name not in known:
            yield match.start(), '%s has no heading "%s"' % (match.group(1),
                                                            name)
    for match in ELSEWHERE.finditer(text):
        yield match.start(), "'%s': name the heading instead" % " ".join(
            match.group(0).split())


def wrong_keys(text, theory, keys):
    if theory:
        for match in BRACKETS.finditer(prose(text)):
            for key in re.findall(r"[A-Z][A-Za-z]*\d{4}|DLMF",
                                  match.group(1)):
                if key not in keys:
                    yield match.start(), "no '%s' in references.bib" % key
    for match in CITE.finditer(text):
        if match.group(1) not in keys | {"key", "Key"}:
            yield match.start(), "no '%s' in references.bib" % match.group(1)


def main():
    root = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else \
        os.path.dirname(os.path.dirname(os.path.dirname(
            os.path.abspath(__file__))))
    texts = {path: read(path) for path in files(root)}
    documents = {path: anchors(without_fences(text))
                 for path, text in texts.items() if path.endswith(".md")}
    quotable = {os.path.basename(path): titles(without_fences(text))
                for path, text in texts.items()
                if os.path.dirname(path) == os.path.join(root, DOCUMENTS)
                and path.endswith(".md")}
    keys = set(re.findall(r"^@\w+\{(\w+),", read(os.path.join(
        root, DOCUMENTS, "references.bib")), re.MULTILINE))
    found = []
    for path, text in texts.items():
        if os.path.abspath(__file__) == path:
            continue
        wrong = list(wrong_names(text, quotable))
        wrong += wrong_keys(text, path.endswith("theory.md"), keys)
        if path.endswith(".md"):
            wrong += wrong_links(path, text, documents)
        found += ["%s:%d: %s" % (os.path.relpath(path, root),
                                 line_of(text, position), what)
                  for position, what in sorted(wrong)]
    if not documents or not keys:
        found.append("no documents under %s" % root)
    for line in found:
        print(line)
    print("%d documents among %d files, %d wrong references" % (
        len(documents), len(texts), len(found)))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
