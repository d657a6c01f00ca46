#!/usr/bin/env python3
"""Shaders at build time: writes the table of embedded texts, and validates entry points with their includes resolved.

A shader's name is its path below src/ without the `shaders` folder: src/frame/shaders/shade.comp is frame/shade.comp.
That name is what `#include "frame/shade.lib.glsl"` says; a file is taken once per program, as with #pragma once.
"""
import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"\s*(?://.*)?$')


def name_of(path, source):
    return "/".join(part for part in path.relative_to(source).parts if part != "shaders")


def path_of(name, source):
    """The file behind a shader's name: the `shaders` folder may stand at any depth below the module."""
    parts = name.split("/")
    for depth in range(1, len(parts)):
        path = source.joinpath(*parts[:depth], "shaders", *parts[depth:])
        if path.is_file():
            return path
    return None


class Flattener:
    """Resolves includes; #line directives carry (line, file number), `files` says which file a number is."""

    def __init__(self, source):
        self.source = source
        self.files = []

    def flatten(self, path):
        number = len(self.files)
        self.files.append(path)
        out = []
        for line_number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
            match = INCLUDE.match(line)
            if not match:
                out.append(line)
                continue
            included = path_of(match.group(1), self.source)
            if included is None:
                sys.exit(f'{path}:{line_number}: error: no shader named "{match.group(1)}" below {self.source}')
            if included in self.files:
                out.append("")
                continue
            out.append(f"#line 1 {len(self.files)}")
            out += self.flatten(included)
            out.append(f"#line {line_number + 1} {number}")
        return out


def stage_of(path):
    return path.name.removesuffix(".glsl").rsplit(".", 1)[1]


def validate(args):
    flattener = Flattener(args.source)
    flat = flattener.flatten(args.shader)
    if not flat or not flat[0].startswith("#version 450 core"):
        sys.exit(f"{args.shader}:1: error: found \"{flat[0] if flat else ''}\", expected #version 450 core")
    with tempfile.NamedTemporaryFile("w", suffix="." + stage_of(args.shader)) as file:
        file.write("\n".join(flat) + "\n")
        file.flush()
        result = subprocess.run([args.validator, "-S", stage_of(args.shader), file.name],
                                capture_output=True, text=True, check=False)
    if result.returncode != 0:
        def place(match):
            return f"{flattener.files[int(match.group(2))]}:{match.group(3)}: {match.group(1).lower()}:"
        lines = [line for line in result.stdout.splitlines() if line.strip() and line.strip() != file.name]
        sys.exit("\n".join(re.sub(r"^(ERROR|WARNING): (\d+):(\d+):", place, line) for line in lines))
    args.stamp.parent.mkdir(parents=True, exist_ok=True)
    dependencies = " ".join(str(path).replace(" ", "\\ ") for path in flattener.files)
    args.depfile.write_text(f"{args.stamp}: {dependencies}\n", encoding="utf-8")
    args.stamp.write_text("", encoding="utf-8")


def embed(args):
    out = ['#include "gl/embedded_shader.h"', "", f"namespace shoal::{args.module} {{", ""]
    if args.shaders:
        out += ["namespace {", "const gl::EmbeddedShader kShaders[] = {"]
        for path in sorted(args.shaders):
            text = path.read_text(encoding="utf-8")
            name = name_of(path, args.source)
            size = len(text.encode("utf-8"))
            out.append(f'    {{"{name}", R"SHOAL_GLSL({text})SHOAL_GLSL", {size}u}},')
        out += ["};", "}  // namespace", ""]
    result = "kShaders" if args.shaders else "{}"
    out += [f"std::span<const gl::EmbeddedShader> embeddedShaders() {{ return {result}; }}", "",
            f"}}  // namespace shoal::{args.module}", ""]
    args.output.parent.mkdir(parents=True, exist_ok=True)
    args.output.write_text("\n".join(out), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    commands = parser.add_subparsers(required=True)
    command = commands.add_parser("embed")
    command.add_argument("--source", type=Path, required=True)
    command.add_argument("--module", required=True)
    command.add_argument("--output", type=Path, required=True)
    command.add_argument("shaders", type=Path, nargs="*")
    command.set_defaults(run=embed)
    command = commands.add_parser("validate")
    command.add_argument("--source", type=Path, required=True)
    command.add_argument("--validator", required=True)
    command.add_argument("--stamp", type=Path, required=True)
    command.add_argument("--depfile", type=Path, required=True)
    command.add_argument("shader", type=Path)
    command.set_defaults(run=validate)
    args = parser.parse_args()
    args.run(args)


if __name__ == "__main__":
    main()
