// SPDX-License-Identifier: BSD-3-Clause
// Packs the extension into a .vsix, which is a zip with a manifest.

import { readFileSync, writeFileSync } from "node:fs";
import { strToU8, zipSync } from "fflate";

const about = JSON.parse(readFileSync("package.json", "utf8"));
const files = [
  "package.json",
  "README.md",
  "LICENSE.txt",
  "language-configuration.json",
  "syntaxes/flexact-deck.tmLanguage.json",
  "out/extension.js",
];

const content = (name) => readFileSync(name === "LICENSE.txt" ? "../../LICENSE" : name);
const asset = (type, path) =>
  `<Asset Type="Microsoft.VisualStudio.${type}" Path="extension/${path}" Addressable="true"/>`;
const manifest = `<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
  <Metadata>
    <Identity Language="en-US" Id="${about.name}" Version="${about.version}" Publisher="${about.publisher}"/>
    <DisplayName>${about.displayName}</DisplayName>
    <Description xml:space="preserve">${about.description}</Description>
    <Categories>${about.categories.join(",")}</Categories>
    <License>extension/LICENSE.txt</License>
    <Properties>
      <Property Id="Microsoft.VisualStudio.Code.Engine" Value="${about.engines.vscode}"/>
      <Property Id="Microsoft.VisualStudio.Code.ExtensionKind" Value="workspace"/>
    </Properties>
  </Metadata>
  <Installation><InstallationTarget Id="Microsoft.VisualStudio.Code"/></Installation>
  <Dependencies/>
  <Assets>
    ${asset("Code.Manifest", "package.json")}
    ${asset("Services.Content.Details", "README.md")}
    ${asset("Services.Content.License", "LICENSE.txt")}
  </Assets>
</PackageManifest>
`;
const types = `<?xml version="1.0" encoding="utf-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
  <Default Extension=".json" ContentType="application/json"/>
  <Default Extension=".js" ContentType="application/javascript"/>
  <Default Extension=".md" ContentType="text/markdown"/>
  <Default Extension=".txt" ContentType="text/plain"/>
  <Default Extension=".vsixmanifest" ContentType="text/xml"/>
</Types>
`;

const packed = {
  "[Content_Types].xml": strToU8(types),
  "extension.vsixmanifest": strToU8(manifest),
};
for (const name of files) packed[`extension/${name}`] = new Uint8Array(content(name));
const target = `${about.name}-${about.version}.vsix`;
// The same files give the same bytes.
writeFileSync(target, zipSync(packed, { mtime: new Date(1980, 0, 1) }));
console.log(`${target} is packed`);
