"""The stages of the project and the arrows between them, read from the sources and from CMake."""

import pathlib
import re

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)
CODE = ("libindet", "libsim", "apps", "tests", "bench")


class Stage:
    def __init__(self, name, folder, depends):
        self.name, self.folder, self.depends = name, folder, depends
        self.includes = set()


def sources(root, *folders):
    """Paths relative to the root of every header and source."""
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in {".h", ".cc", ".in"} and path.is_file():
                yield path.relative_to(root)


def included(path):
    """(quoted, path as written) of every include of a file."""
    return [(mark == '"', name) for mark, name in INCLUDE.findall(path.read_text())]


def read_stages(root):
    """The stages that CMake knows, each with what it may depend on and what its files include."""
    stages = {}
    for path in sorted(root.glob("lib*/**/CMakeLists.txt")) + sorted(root.glob("apps/**/CMakeLists.txt")):
        for call in re.findall(r"^indet_add_stage\(([^()]*(?:\([^()]*\)[^()]*)*)\)", path.read_text(), re.MULTILINE):
            words = call.split()
            depends = set()
            if "DEPENDS" in words:
                for word in words[words.index("DEPENDS") + 1:]:
                    if word.isupper() or word.endswith("LIBRARIES"):
                        break
                    depends.add(word)
            stages[words[0]] = Stage(words[0], path.parent.relative_to(root), depends)
    by_folder = {stage.folder: stage for stage in stages.values()}
    for stage in stages.values():
        for source in (root / stage.folder).iterdir():
            if source.suffix not in {".h", ".cc", ".in"}:
                continue
            for quoted, name in included(source):
                other = by_folder.get(pathlib.PurePath(name).parent) if quoted else None
                if other and other is not stage:
                    stage.includes.add(other.name)
    return stages


def in_order(stages):
    """Names of the stages, each after all those that it includes; ties by name. ValueError for a circle."""
    ordered = []
    while len(ordered) < len(stages):
        ready = sorted(name for name, stage in stages.items() if name not in ordered and stage.includes <= set(ordered))
        if not ready:
            raise ValueError("a circle among " + ", ".join(sorted(set(stages) - set(ordered))))
        ordered.append(ready[0])
    return ordered


def arrows(stages):
    """One line a stage: its folder and the stages whose headers it includes."""
    width = max(len(str(stage.folder)) for stage in stages.values())
    order = in_order(stages)
    lines = []
    for name in order:
        stage = stages[name]
        targets = " ".join(other for other in order if other in stage.includes)
        lines.append(f"{str(stage.folder):{width}} ─▶ {targets}" if targets else str(stage.folder))
    return "\n".join(lines) + "\n"
