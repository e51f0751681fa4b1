"""What counts as following a page: a page with a mistake must fail."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import page  # noqa: E402


def follow(text):
    """Status and words of following a page with this text."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "page.md")
        file.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, page.__file__, str(file), folder], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


class Page(unittest.TestCase):
    def test_saves_runs_and_compares(self):
        status, said = follow("```xml a/b.txt\none\ntwo\n```\n```sh\ncat a/b.txt\n```\n```output\none\nt…\n```\n")
        self.assertEqual(status, 0, said)

    def test_a_failing_command(self):
        self.assertEqual(follow("```sh\nfalse\n```\n")[0], 1)
        self.assertEqual(follow("```sh\nfalse\ntrue\n```\n")[0], 1)
        self.assertEqual(follow("```sh exits=1\nfalse\n```\n")[0], 0)
        self.assertEqual(follow("```sh exits=2\nfalse\n```\n")[0], 1)

    def test_output_that_differs(self):
        for shown in ("other", "two\none", "one\none", "on"):
            self.assertEqual(follow(f"```sh\nprintf 'one\\ntwo\\n'\n```\n```output\n{shown}\n```\n")[0], 1, shown)

    def test_the_shell_stays(self):
        status, said = follow("```sh\nmkdir a\ncd a\nexport B='c d'\n```\n```sh\npwd\necho $B\n```\n```output\n…/a\nc d\n```\n"
                              "```xml f\nx\n```\n```sh\ncat ../f\n```\n```output\nx\n```\n")
        self.assertEqual(status, 0, said)

    def test_a_change(self):
        saved = "```xml f\na\nb\nc\n```\n"
        self.assertEqual(follow(saved + "```diff f\n a\n-b\n+B\n```\n```sh\ngrep -qx B f\n! grep -qx b f\n```\n")[0], 0)
        self.assertEqual(follow(saved + "```diff f\n-z\n+B\n```\n")[0], 1)
        self.assertEqual(follow("```diff f\n-z\n+B\n```\n")[0], 1)

    def test_a_block_that_nobody_runs(self):
        for text in ("```\nx\n```\n", "```xml\nx\n```\n", "```sh\n", "```output\nx\n```\n",
                     "<!-- not run: no time -->\n```sh\nfalse\n```\n"):
            self.assertEqual(follow(text)[0], 1, text)
        status, said = follow("<!-- not run: needs a device -->\n```sh\nfalse\n```\n")
        self.assertEqual(status, 0)
        self.assertIn("1 left out", said)


if __name__ == "__main__":
    unittest.main()
