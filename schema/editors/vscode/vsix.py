#!/usr/bin/python3
"""vsix.py FILE: packs the extension, which build.mjs has made, as `code --install-extension FILE` takes it. A
package is an archive with the extension and a manifest that repeats some of package.json. The same sources give the
same bytes."""
import json
import pathlib
import sys
import zipfile
from xml.sax.saxutils import escape, quoteattr

HERE = pathlib.Path(__file__).resolve().parent
MOST = 200_000  # bytes
FILES = {"package.json": "package.json", "readme.md": "README.md", "LICENSE.txt": "../../../LICENSE",
         "dist/extension.js": "dist/extension.js", "dist/licenses.txt": "dist/licenses.txt",
         "snippets/trees.json": "snippets/trees.json",
         "syntaxes/script.json": "syntaxes/script.json",
         "syntaxes/script.injection.json": "syntaxes/script.injection.json"}
TYPES = {".js": "application/javascript", ".json": "application/json", ".md": "text/markdown", ".txt": "text/plain",
         ".vsixmanifest": "text/xml"}


def content_types():
    rows = "".join(f'<Default Extension="{it}" ContentType="{kind}"/>' for it, kind in TYPES.items())
    return ('<?xml version="1.0" encoding="utf-8"?>\n<Types '
            f'xmlns="http://schemas.openxmlformats.org/package/2006/content-types">{rows}</Types>\n')


def manifest(about):
    identity = f'Language="en-US" Id={quoteattr(about["name"])} Version={quoteattr(about["version"])}'
    properties = {"Code.Engine": about["engines"]["vscode"], "Code.ExtensionKind": "workspace",
                  "Code.ExecutesCode": "true"}
    rows = "\n".join(f'      <Property Id="Microsoft.VisualStudio.{name}" Value={quoteattr(value)}/>'
                     for name, value in properties.items())
    return f"""<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
  <Metadata>
    <Identity {identity} Publisher={quoteattr(about["publisher"])}/>
    <DisplayName>{escape(about["displayName"])}</DisplayName>
    <Description xml:space="preserve">{escape(about["description"])}</Description>
    <Categories>{escape(",".join(about["categories"]))}</Categories>
    <Properties>
{rows}
    </Properties>
    <License>extension/LICENSE.txt</License>
  </Metadata>
  <Installation>
    <InstallationTarget Id="Microsoft.VisualStudio.Code"/>
  </Installation>
  <Dependencies/>
  <Assets>
    <Asset Type="Microsoft.VisualStudio.Code.Manifest" Path="extension/package.json" Addressable="true"/>
    <Asset Type="Microsoft.VisualStudio.Services.Content.Details" Path="extension/readme.md" Addressable="true"/>
    <Asset Type="Microsoft.VisualStudio.Services.Content.License" Path="extension/LICENSE.txt" Addressable="true"/>
  </Assets>
</PackageManifest>
"""


def pack(target):
    about = json.loads((HERE / "package.json").read_text())
    parts = {"extension.vsixmanifest": manifest(about).encode(), "[Content_Types].xml": content_types().encode()}
    parts.update({f"extension/{name}": (HERE / source).read_bytes() for name, source in FILES.items()})
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in parts.items():
            archive.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), content, zipfile.ZIP_DEFLATED, 9)
    size = pathlib.Path(target).stat().st_size
    print(f"{target}: {size} bytes")
    if size > MOST:
        sys.exit(f"vsix.py: it has {size} bytes, at most {MOST} are allowed")


pack(sys.argv[1])
