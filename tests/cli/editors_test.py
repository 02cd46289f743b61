"""The set-up of docs/editors.md with the real YAML language server (npm install -g yaml-language-server, or its folder
in YAML_LANGUAGE_SERVER): it marks slips, completes names and tells what fields mean."""

import json
import os
import re
import shutil
import subprocess
import unittest

from program import ProgramTest, ROOT

SERVER = os.environ.get("YAML_LANGUAGE_SERVER") or shutil.which("yaml-language-server")


class Server:
    """Messages of the Language Server Protocol over pipes."""

    def __init__(self, folder):
        self.process = subprocess.Popen([SERVER, "--stdio"], cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL)
        self.number = 0
        self.diagnostics = {}

    def send(self, **message):
        data = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(data) + data)
        self.process.stdin.flush()

    def receive(self):
        length = 0
        while True:
            line = self.process.stdout.readline().strip()
            if not line:
                break
            if line.lower().startswith(b"content-length:"):
                length = int(line.split(b":")[1])
        message = json.loads(self.process.stdout.read(length))
        if message.get("method") == "textDocument/publishDiagnostics":
            self.diagnostics[message["params"]["uri"]] = message["params"]["diagnostics"]
        elif "method" in message and "id" in message:
            items = message["params"].get("items", []) if isinstance(message.get("params"), dict) else []
            self.send(id=message["id"], result=[self.settings.get(item.get("section")) for item in items])
        return message

    def ask(self, method, parameters):
        self.number += 1
        number = self.number
        self.send(id=number, method=method, params=parameters)
        while True:
            message = self.receive()
            if message.get("id") == number and "method" not in message:
                return message["result"]

    def end(self):
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()


class Editors(ProgramTest):
    def test_settings_are_json(self):
        blocks = re.findall(r"```json\n(.*?)```", (ROOT / "docs/editors.md").read_text(), re.DOTALL)
        self.assertEqual(len(blocks), 2)
        pattern = json.loads(blocks[1])["tasks"][0]["problemMatcher"]["pattern"]["regexp"]
        self.write("ring.yaml", "lekalo: 1\ngeometry: { a: { type: ball, radius: -1 } }\n")
        errors = self.run_program("check", "ring.yaml", code=3)[1].split("\n")
        found = [re.match(pattern, line) for line in errors]
        self.assertEqual([match[2] for match in found if match], ["2"])

    @unittest.skipUnless(SERVER, "yaml-language-server is not installed (npm install -g yaml-language-server)")
    def test_language_server(self):
        schema = self.folder / "lekalo.schema.json"
        schema.write_text(self.run_program("schema")[0])
        block = re.search(r"```json\n(.*?)```", (ROOT / "docs/editors.md").read_text(), re.DOTALL)[1]
        settings = json.loads(block.replace("/home/me/.config/lekalo/lekalo.schema.json", str(schema)))
        server = Server(self.folder)
        self.addCleanup(server.end)
        yaml = {"schemas": settings["yaml.schemas"], "validate": True, "completion": True, "hover": True,
                "schemaStore": {"enable": False}}
        server.settings = {"yaml": yaml}
        server.ask("initialize", {"processId": None, "rootUri": self.folder.as_uri(), "capabilities": {
            "workspace": {"configuration": True}, "textDocument": {"hover": {"contentFormat": ["markdown"]}}}})
        server.send(method="initialized", params={})
        server.send(method="workspace/didChangeConfiguration", params={"settings": {"yaml": yaml}})
        uri = (self.folder / "ring.lekalo.yaml").as_uri()
        text = "lekalo: 1\ngeometry:\n  c:\n    type: circle\n    radios: 1\n    \nimage: { samples: 4 }\n"
        server.send(method="textDocument/didOpen", params={"textDocument": {"uri": uri, "languageId": "yaml", "version": 1, "text": text}})
        while not server.diagnostics.get(uri):
            server.receive()
        marked = [one["range"]["start"]["line"] for one in server.diagnostics[uri]]
        self.assertIn(4, marked, server.diagnostics[uri])
        here = {"textDocument": {"uri": uri}, "position": {"line": 5, "character": 4}}
        offered = server.ask("textDocument/completion", here)
        names = [item["label"] for item in (offered["items"] if isinstance(offered, dict) else offered)]
        self.assertIn("radius", names)
        hover = server.ask("textDocument/hover", {"textDocument": {"uri": uri}, "position": {"line": 6, "character": 12}})
        self.assertIn("default `16`", json.dumps(hover))


if __name__ == "__main__":
    unittest.main()
