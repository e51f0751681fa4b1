#!/usr/bin/python3
"""Builds the guide: the pages of docs/, a reference made from manifests and help texts, and the interface of plug-ins from its headers.

usage: guide.py BUILD OUT
BUILD is the build folder, whose program and plug-ins the reference describes; OUT/index.html is the guide's first page. The whole
works without a network. Every warning of Sphinx is an error: a dead link, a page that no table of contents names.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

ROOT = pathlib.Path(__file__).resolve().parent.parent
KATEX = pathlib.Path("/usr/share/javascript/katex")
KATEX_FONTS = pathlib.Path("/usr/share/fonts/truetype/katex")

# pages of the repository that are also pages of the guide, and the titles of those that are called after their folder
TITLES = {
    "config/cave/README.md": "Walls of a CAVE",
    "config/schema/README.md": "Experiments",
    "framework/record/README.md": "Recordings",
    "apps/python/README.md": "The Python package",
}
PAGES = {
    "config/README.md": "reference/scenes.md",
    "config/DEFAULTS.md": "reference/defaults.md",
    "config/JOINTS.md": "reference/joints.md",
    "config/MODELS.md": "reference/models.md",
    "config/HOLLOW_BODIES.md": "reference/hollow_bodies.md",
    "config/PERCRO_2006.md": "reference/percro_2006.md",
    "config/cave/README.md": "reference/walls.md",
    "config/schema/README.md": "reference/experiments.md",
    "framework/record/README.md": "reference/recordings.md",
    "apps/python/README.md": "reference/python.md",
    "CHANGELOG.md": "reference/changes.md",
}
LINK = re.compile(r"(!?\[[^\]]*\]\()([^)#\s]+)(#[^)\s]*)?\)")

KINDS = {
    "force_effect": ("Force effects", "a force on each fingertip, and its reaction on a body"),
    "body_effect": ("Body effects", "a force and a torque on bodies"),
    "surface_effect": ("Surface effects", "normal, depth or stiffness where a fingertip touches"),
    "friction_law": ("Friction laws", "the tangential force of each contact"),
    "renderer": ("Renderers", "where surfaces hold each fingertip"),
    "module": ("Modules", "a part of the graph"),
    "view_part": ("Parts of the view", "lines in the picture of a run"),
    "device": ("Devices", "what a rig may name as `driver`, with its settings"),
    "method": ("Methods", "the next level of an experiment"),
    "metric": ("Metrics", "an error that `presa cost` measures"),
}


def relinked(text, source, page):
    """The links of a page that moves from `source` (relative to the repository) to `page` (relative to the guide)."""

    def link(found):
        before, target, anchor = found[1], found[2], found[3] or ""
        if ":" in target:
            return found[0]
        path = os.path.normpath(os.path.join(os.path.dirname(source), target))
        if path in PAGES:
            new = PAGES[path]
        elif path.startswith("docs/"):
            new = path.removeprefix("docs/")
        elif (ROOT / path).is_file():
            new = "files/" + path
        else:
            raise SystemExit(f"{source}: there is no file {path}")
        return f"{before}{os.path.relpath(new, os.path.dirname(page))}{anchor})"

    parts = re.split(r"(^```.*?^```$|`[^`\n]+`)", text, flags=re.S | re.M)  # code stays as it is
    return "".join(part if part.startswith("`") else LINK.sub(link, part) for part in parts)


def files_of(text, source):
    """Pictures and other files of the repository that a page shows."""
    for _, target, _ in LINK.findall(text):
        path = os.path.normpath(os.path.join(os.path.dirname(source), target))
        if ":" not in target and path not in PAGES and not path.startswith("docs/"):
            yield path


def write(folder, page, text):
    file = folder / page
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")


def copy_pages(folder):
    sources = {str(file.relative_to(ROOT)): str(file.relative_to(ROOT / "docs")) for file in (ROOT / "docs").rglob("*.md")}
    for source, page in {**sources, **PAGES}.items():
        text = (ROOT / source).read_text(encoding="utf-8")
        for path in files_of(text, source):
            target = folder / "files" / path
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / path, target)
        text = relinked(text, source, page)
        if source in TITLES:
            text = re.sub(r"^# .*$", f"# {TITLES[source]}", text, count=1, flags=re.M)
        write(folder, page, text)


def cell(text):
    return (text or "").replace("|", "\\|").replace("<", "&lt;")


def range_of(attribute):
    said = [f"above {attribute.get('above')}"] if attribute.get("above") else []
    said += [f"min {attribute.get('min')}"] if attribute.get("min") else []
    said += [f"max {attribute.get('max')}"] if attribute.get("max") else []
    return ", ".join(said)


def attribute_rows(attributes, required):
    yield "| name | type | unit | default | range | meaning |"
    yield "|---|---|---|---|---|---|"
    for attribute in attributes:
        default = attribute.get("default")
        shown = required if default is None else f"`{default}`" if default else "empty"
        yield (f"| `{attribute.get('name')}` | {attribute.get('type')} | {cell(attribute.get('unit'))} | {shown} | "
               f"{range_of(attribute)} | {cell(attribute.get('about'))} |")


def about_plug_in(plugin):
    yield f"### {plugin.get('name')}\n"
    yield f"{cell(plugin.get('about'))}\n"
    for element in plugin.iter("element"):
        place = element.get("in")
        yield f"`<{element.get('name')}>` in `<{place}>`\n" if place else f"`<{element.get('name')}>`\n"
        attributes = element.findall("attribute")
        if attributes:
            yield from attribute_rows(attributes, "required")
            yield ""
    settings = plugin.findall("setting")
    if settings:
        yield from attribute_rows(settings, "")
        yield ""


def elements_page(build):
    """What plug-ins bring, from their manifests."""
    plugins = [xml.parse(file).getroot() for file in sorted((build / "lib/presa").glob("presa_*.xml"))]
    if not plugins:
        raise SystemExit(f"there is no manifest in {build}/lib/presa: build Presa first")
    yield "# Elements and drivers of plug-ins\n"
    yield "Made from the manifests of the plug-ins that come with Presa. `presa plugins` lists those that are installed.\n"
    for kind, (title, gives) in KINDS.items():
        chosen = [plugin for plugin in plugins if plugin.get("kind") == kind]
        if not chosen:
            continue
        yield f"## {title}\n\nEach gives {gives}.\n" if kind not in ("device",) else f"## {title}\n\nEach is {gives}.\n"
        for plugin in chosen:
            yield from about_plug_in(plugin)


def help_of(program, words):
    done = subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True)
    return done.stdout


def command_parts(program, words=()):
    """A heading and the help text of each command, those below a command behind it."""
    text = help_of(program, words)
    name = " ".join(["presa", *words])
    yield f"{'##' if len(words) < 2 else '###'} {name}\n"
    yield f"```text\n{text.rstrip()}\n```\n"
    below = re.search(r"^Subcommands:\n(.*?)(?:\n\n|\Z)", text, re.S | re.M)
    for command in re.findall(r"^  ([a-z][a-z-]*) ", below[1], re.M) if below else []:
        yield from command_parts(program, (*words, command))


def errors_page():
    """Numbers of errors and warnings, without the files that use them."""
    text = (ROOT / "framework/core/diagnostics/CODES.md").read_text(encoding="utf-8")
    for line in text.splitlines():
        if line.startswith("|"):
            number, meaning = [part.strip() for part in line.strip("|").split("|")][:2]
            yield f"| {number} | {meaning} |"
        elif not line.startswith(("Each number", "names the files")):
            yield line


def copy_formulas(folder):
    target = folder / "_static/katex"
    (target / "contrib").mkdir(parents=True)
    for name in ("katex.min.css", "katex.min.js", "contrib/auto-render.min.js"):
        source = KATEX / name if (KATEX / name).exists() else KATEX / name.replace(".min.js", ".js")
        shutil.copy(source, target / name)
    shutil.copytree(KATEX_FONTS, target / "fonts")


def api(build, out):
    """The interface of plug-ins. Returns what Doxygen complains about."""
    headers = (build / "interface_headers.txt").read_text(encoding="utf-8").split()
    headers = [header for header in headers if not header.startswith("tests/")]
    version = re.search(r"PROJECT_VERSION:STATIC=(.*)|CMAKE_PROJECT_VERSION:STATIC=(.*)", (build / "CMakeCache.txt").read_text())
    settings = (ROOT / "docs/Doxyfile").read_text(encoding="utf-8")
    settings += f"\nINPUT = {' '.join(headers)}\nOUTPUT_DIRECTORY = {out}\nPROJECT_NUMBER = {version[1] or version[2]}\n"
    done = subprocess.run(["doxygen", "-"], cwd=ROOT, input=settings, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(done.stderr)
    return [line for line in done.stderr.splitlines() if "warning:" in line]


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    build, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory(prefix=f"presa_guide_{os.getpid()}_") as scratch:
        folder = pathlib.Path(scratch)
        copy_pages(folder)
        write(folder, "reference/elements.md", "\n".join(elements_page(build)))
        write(folder, "reference/commands.md", "# Commands\n\nWhat each command says of itself with `--help`.\n\n" +
              "\n".join(command_parts(build / "bin/presa")))
        write(folder, "reference/errors.md", "\n".join(errors_page()))
        shutil.copy(ROOT / "docs/conf.py", folder)
        shutil.copytree(ROOT / "docs/_static", folder / "_static")
        copy_formulas(folder)
        shutil.rmtree(out, ignore_errors=True)
        sphinx = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", "-d", f"{scratch}/.cache", scratch, str(out)]
        if subprocess.run(sphinx, check=False).returncode:
            return 1
    complaints = api(build, out)
    for line in complaints:
        print(line)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
