"""The pages in DONE have the terms of docs/glossary.md and short sentences, and messages and help have these terms:
words_test.py SOURCES [PAGE...].

Refuses the words in REFUSED, and in pages sentences that are too long. Code, output and links are not read. A page that was revised
is added to DONE. Messages and help are the texts in the sources of interpreter/. With PAGE it reads that page instead, to see what is
left to do."""
import glob
import os
import re
import sys

SOURCES = sys.argv[1]

DONE = [
    "CONTRIBUTING.md",
    "README.md",
    "SECURITY.md",
    "SUPPORT.md",
    "docs/architecture.md",
    "docs/authoring.md",
    "docs/btcpp.md",
    "docs/cli.md",
    "docs/deadlocks.md",
    "docs/decisions/README.md",
    "docs/decisions/isolation.md",
    "docs/decisions/languages.md",
    "docs/decisions/loading.md",
    "docs/decisions/page.md",
    "docs/decisions/parameters-from-entries.md",
    "docs/decisions/programs.md",
    "docs/decisions/recording-packets.md",
    "docs/decisions/ticking.md",
    "docs/decisions/twice.md",
    "docs/editors.md",
    "docs/embedding.md",
    "docs/expressions.md",
    "docs/from-behaviortree-cpp.md",
    "docs/glossary.md",
    "docs/guards.md",
    "docs/road.md",
    "docs/index.md",
    "docs/language.md",
    "docs/language_server.md",
    "docs/mcp.md",
    "docs/late_progress.md",
    "docs/messages.md",
    "docs/monitor.md",
    "docs/new.md",
    "docs/nodes-and-attributes.md",
    "docs/pacing.md",
    "docs/why.md",
    "docs/debugging.md",
    "docs/people.md",
    "docs/packages.md",
    "docs/paper.md",
    "docs/performance.md",
    "docs/plugins.md",
    "docs/programs.md",
    "docs/properties.md",
    "docs/recipes.md",
    "docs/recording.md",
    "docs/resume.md",
    "docs/team.md",
    "docs/reliability.md",
    "docs/roadmap.md",
    "docs/ros2.md",
    "docs/security.md",
    "docs/sequel.md",
    "docs/studies.md",
    "docs/testing.md",
    "docs/tutorial.md",
    "docs/verify.md",
    "docs/versions.md",
    "schema/editors/vscode/README.md",
    "trees/README.md",
]

REFUSED = {  # what is refused: what to write
    r"(goes|go|going|went|comes|come) on\b": "continues, resumes, makes progress",
    r"(?:(?<=[.;:,(] )|(?<=^))else\b": "otherwise",
    r"\b(nobody|somebody|everybody)\b": "no node, another process, you",
    r"\bbeside\b": "next to, alongside, compared with",
    r"\bfor ?ever\b": "indefinitely; a deadlock",
    r"\b(says?|said|tells?|told|denies|denied)\b": "reports, documents, contradicts",
    r"\b(is|are) to\b": "must, should",
    r"\b(half of (its|the)|their|its) way\b": "distance, halfway",
    r"\b(it|that|this|which) is no\b(?! longer)": "is not a",
    r"\b(taken?|takes|took) \w+ for an?\b": "treats as",
    r"\blikewise\b|, too\b": "leave it out",
    r"(?:(?<=[.?!:] )|^(?:[-*] |\d+\. )?)so\b(?! (are|do|does|far|that)\b)": "Therefore, or leave it out",
    r"(?:(?<=[.?!] )|^(?:[-*] |\d+\. )?)of (a|an|all|both|each|every|one|the|these|those|two)\b": "For, or the subject first",
    r"\bstandstills?\b|\bstands? still\b": "stall",
    r"\bcircles?\b": "deadlock, circular wait",
    r"\blaws?\b": "semantics, semantics version",
    r"\bleaf files?\b": "leaf model",
    r"\btraps?\b": "dead end",
    r"\bshare of\b": "fraction of",
    r"\bblanks?\b": "whitespace",
    r"\btroubles?\b": "problem",
    r"\bequal child(ren)?\b": "symmetric children",
    r"\bplugins? that (is|are) (a )?programs?\b": "process plugin",
    r"\b(behaviour|colour|neighbour|grey|honour|favour|centre|cancelled|modelling)": "the American spelling",
}
WITHOUT_CONTENTS = ["README.md", "docs/index.md"]
LONGEST = 27  # words in a sentence

# Where a refused word is right: the page, the words around it, and why.
EXCEPTIONS = [("docs/glossary.md", f"| {old} |", "the column of the terms that messages still use")
              for old in ("trap", "circle", "leaf file", "law", "standstill")]
IN_MESSAGES = [("cli/tools/verify/verify.cpp", "trap", "the name of a finding"),
               ("study/plots/box_plot.cpp", "circle", "the sign in a plot")]
TEXT = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')


def messages():
    """(file, line number, text) of each text of several words in the sources of the program, without comments."""
    for path in glob.glob(os.path.join(SOURCES, "interpreter/**/*.[ch]*"), recursive=True):
        if not path.endswith((".cpp", ".h")) or "/page/" in path:
            continue
        with open(path, encoding="utf-8") as file:
            source = re.sub(r"^\s*//.*$|(?<=[;{},)]) *// .*$", "", file.read(), flags=re.M)
        for match in TEXT.finditer(source):
            text = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', match[0])).replace("\\n", " ")
            if " " in text.strip():
                yield os.path.relpath(path, os.path.join(SOURCES, "interpreter")), source.count("\n", 0, match.start()) + 1, text


def prose(page):
    """(line number, text) of each paragraph, row and item, without code, links and comments, and without what `./dev generate`
    writes between comments: its words are those of its source."""
    with open(os.path.join(SOURCES, page), encoding="utf-8") as text:
        lines = text.read().splitlines()
    paragraph, begins, code = [], 0, False
    for number, line in [*enumerate(lines, 1), (len(lines) + 1, "")]:
        if line.lstrip().startswith("```"):
            code = not code
            line = ""
        elif re.match(r"<!-- /?lines\b", line):
            code = not line.startswith("<!-- /")
        elif code:
            continue
        starts = not line.strip() or re.match(r"\s*([-*|#]|\d+\.|<!--|!\[)", line)
        if starts and paragraph:
            yield begins, " ".join(paragraph)
            paragraph = []
        if line.strip() and not re.match(r"\s*(<!--|!\[)", line):
            paragraph.append(line.strip())
            begins = begins if len(paragraph) > 1 else number


def plain(text):
    text = re.sub(r"`[^`]*`", "CODE", text)
    text = re.sub(r"\*[^*\s][^*]*\*(?!\*)", lambda it: "QUOTE" if it[0].count(" ") > 3 else it[0], text)
    text = re.sub(r"<a id=[^>]*></a>", "", text)
    return re.sub(r"\]\([^)]*\)", "]", text)


def missing_contents(page):
    """The headings that the contents list of a page lacks; a page without a list lacks none if it is short."""
    with open(os.path.join(SOURCES, page), encoding="utf-8") as text:
        source = re.sub(r"```.*?```", "", text.read(), flags=re.S)
    headings = re.findall(r"^## (.*)$", source, re.M)
    listed = re.findall(r"\]\(#([^)]*)\)", source.split("\n## ")[0])
    anchors = [re.sub(r"[^a-z0-9 _-]", "", it.lower()).replace(" ", "-") for it in headings]
    return [] if page in WITHOUT_CONTENTS else [it for it in anchors if it not in listed]


wrong = []
used = set()
for page in sys.argv[2:] or DONE:
    wrong += [f"{page}: the list of contents lacks #{it}" for it in missing_contents(page)]
    for number, raw in prose(page):
        text = plain(raw)
        for pattern, instead in REFUSED.items():
            for match in re.finditer(pattern, text, re.I):
                reason = [at for at, (where, words, _) in enumerate(EXCEPTIONS) if where == page and words in text]
                used.update(reason)
                if not reason:
                    wrong.append(f"{page}:{number}: '{match[0].strip()}': write {instead}\n    …{text[max(0, match.start() - 40):match.end() + 40]}…")
        cells = text.strip("|").split(" | ") if text.startswith("|") else [text]
        for sentence in (it for cell in cells for it in re.split(r"(?<=[.;:?!])\*{0,2} ", cell)):
            words = len(sentence.split())
            if words > LONGEST:
                wrong.append(f"{page}:{number}: a sentence of {words} words, at most {LONGEST}\n    {sentence[:100]}…")
for file, number, raw in [] if sys.argv[2:] else messages():
    text = plain(raw)
    for pattern, instead in REFUSED.items():
        if instead in ("For, or the subject first", "Therefore, or leave it out"):
            continue  # a message need not be a sentence
        for match in re.finditer(pattern, text, re.I):
            if not any(where == file and word in match[0] for where, word, _ in IN_MESSAGES):
                wrong.append(f"interpreter/{file}:{number}: '{match[0].strip()}': write {instead}\n    …{text[:200]}…")
if not sys.argv[2:]:
    wrong += [f"an exception that nothing needs: {EXCEPTIONS[at]}" for at in range(len(EXCEPTIONS)) if at not in used]
if wrong:
    sys.exit("\n".join(wrong) + f"\n{len(wrong)} to write again")
