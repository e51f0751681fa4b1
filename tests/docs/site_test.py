"""The whole guide: built without a warning, searched and drawn by a browser, from files alone."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = os.environ.get("BUILD", str(ROOT / "build"))
BROWSER = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=10000", "--dump-dom"]


def seen(url):
    """The page as a browser has it after its scripts ran."""
    with tempfile.TemporaryDirectory() as home:
        done = subprocess.run([*BROWSER, f"--user-data-dir={home}", url], capture_output=True, text=True, timeout=120, check=False)
    return done.stdout


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = pathlib.Path(cls.folder.name, "guide")
        cls.built = subprocess.run(["/usr/bin/python3", ROOT / "docs/guide.py", BUILD, cls.out], capture_output=True, text=True,
                                   check=False)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_builds_without_a_warning(self):
        self.assertEqual(self.built.returncode, 0, self.built.stdout[-5000:] + self.built.stderr[-5000:])

    def test_search_finds_pages_without_a_server(self):
        page = seen(f"file://{self.out}/search.html?q=friction")
        self.assertGreater(len(re.findall(r'<li class="kind-', page) or re.findall(r"search-result|<ul class=\"search\"><li", page)),
                           0, page[-3000:])

    def test_formulas_are_drawn(self):
        page = seen(f"file://{self.out}/understand/references.html")
        self.assertIn('class="katex', page)
        self.assertNotIn("katex-error", page)

    def test_the_reference_knows_a_plug_in_a_command_and_an_error(self):
        for name, words in (("elements", "gain"), ("commands", "--lockstep"), ("errors", "XML is not well-formed")):
            self.assertIn(words, (self.out / f"reference/{name}.html").read_text(encoding="utf-8"))

    def test_the_interface_of_plug_ins(self):
        self.assertTrue((self.out / "api/index.html").exists())

    def test_every_package_of_a_run_has_its_license_named(self):
        page = (ROOT / "docs/third_party.md").read_text(encoding="utf-8")
        wanted = re.search(r"^\[base\]$(.*?)^\[", (ROOT / "config/packages.txt").read_text(encoding="utf-8"), re.M | re.S)[1]
        packages = [line.split()[0] for line in wanted.splitlines() if line.strip() and not line.startswith("#")]
        self.assertGreater(len(packages), 20)
        self.assertEqual([package for package in packages if f"`{package}`" not in page], [])

    def test_every_link_of_every_page_leads_somewhere(self):
        dead = []
        for page in self.out.rglob("*.html"):
            if page.is_relative_to(self.out / "api"):
                continue  # Doxygen's own
            for target in re.findall(r'(?:href|src)="([^"#?]+)', page.read_text(encoding="utf-8")):
                if re.match(r"[a-z]+:", target):
                    continue
                if not (page.parent / target).exists():
                    dead.append(f"{page.relative_to(self.out)}: {target}")
        self.assertEqual(dead, [])

    def test_a_dead_link_is_an_error(self):
        done = subprocess.run(["/usr/bin/python3", "-c",
                               "import guide; guide.relinked('[x](nowhere.md)', 'config/README.md', 'reference/scenes.md')"],
                              cwd=ROOT / "docs", capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("nowhere.md", done.stderr)


if __name__ == "__main__":
    unittest.main()
