"""Figures by the program lekalo in documents of Sphinx: extensions = ["lekalo_sphinx"] in conf.py.

    .. lekalo:: ring.yaml
       :set: r=0.5 R=2
       :width: 84
       :alt: a ring

    .. lekalo::

       lekalo: 1
       geometry: { c: { type: circle, radius: 1 } }

`width` is in millimetres. A figure is called after a hash of its scene and options and is made only where it is missing,
as SVG and PDF beside each other. `lekalo_program` in conf.py names the program.
"""

import hashlib
import pathlib
import subprocess

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.util.docutils import SphinxDirective


class Lekalo(SphinxDirective):
    has_content = True
    optional_arguments = 1
    final_argument_whitespace = True
    option_spec = {"set": directives.unchanged, "width": directives.unchanged, "alt": directives.unchanged,
                   "align": directives.unchanged, "name": directives.unchanged}

    def run(self):
        folder = pathlib.Path(self.env.srcdir) / "_lekalo"
        folder.mkdir(exist_ok=True)
        if self.arguments:
            _, name = self.env.relfn2path(self.arguments[0])
            scene = pathlib.Path(name)
            self.env.note_dependency(name)
            if not scene.exists():
                return [self.state.document.reporter.error(f"lekalo: there is no scene '{name}'", line=self.lineno)]
        else:
            text = "\n".join(self.content) + "\n"
            scene = folder / (hashlib.sha1(text.encode()).hexdigest() + ".yaml")
            scene.write_text(text)
        options = [word for one in self.options.get("set", "").split() for word in ("--set", one)]
        if "width" in self.options:
            options += ["--width", self.options["width"]]
        key = hashlib.sha1(scene.read_bytes() + "\0".join(options).encode()).hexdigest()
        missing = [folder / (key + ending) for ending in (".svg", ".pdf") if not (folder / (key + ending)).exists()]
        if missing:
            command = [self.config.lekalo_program, "draw", str(scene), "--quiet", *options]
            done = subprocess.run(command + [word for file in missing for word in ("-o", str(file))], capture_output=True,
                                  text=True)
            if done.returncode:
                return [self.state.document.reporter.error("lekalo: " + done.stderr, line=self.lineno)]
        # Named from the folder of the document.
        depth = len(pathlib.PurePosixPath(self.env.docname).parts) - 1
        image = nodes.image(uri="../" * depth + f"_lekalo/{key}.*", alt=self.options.get("alt", ""))
        if "align" in self.options:
            image["align"] = self.options["align"]
        self.add_name(image)
        return [image]


def setup(app):
    app.add_config_value("lekalo_program", "lekalo", "env")
    app.add_directive("lekalo", Lekalo)
    return {"parallel_read_safe": True}
