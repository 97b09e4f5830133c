#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Make python/flexact/show/page/three.min.js: the parts of three.js that the page uses,
# as one script that sets the global THREE. Needs node, npm and a package registry;
# the result is kept in the repository, so that nobody else needs them.
set -eu
three=0.187.0
esbuild=0.28.2
target=$(cd "$(dirname "$0")/.." && pwd)/python/flexact/show/page/three.min.js

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
printf '{"private": true}\n' >package.json
npm install --silent --no-audit --no-fund --save-exact "three@$three" "esbuild@$esbuild"

cat >parts.js <<'PARTS'
export {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, ConeGeometry, CylinderGeometry, DepthTexture,
  DirectionalLight, DoubleSide, DynamicDrawUsage, Group, HemisphereLight, InstancedMesh,
  LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial,
  OrthographicCamera, PlaneGeometry, Quaternion, Raycaster, Scene, ShaderMaterial, Sphere,
  SphereGeometry, TorusGeometry, Vector2, Vector3, WebGLRenderTarget, WebGLRenderer
} from 'three';
export { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
PARTS

{
    printf '/*! three.js %s (parts), https://threejs.org\n\n' "$three"
    cat node_modules/three/LICENSE
    printf '*/\n'
} >head.txt
npx esbuild parts.js --bundle --minify --format=iife --global-name=THREE \
    --target=es2020 --legal-comments=none --log-level=warning --outfile=body.js
# A page that embeds the script must not end it.
if grep -qi '</script' body.js; then
    echo "the bundle holds </script" >&2
    exit 1
fi
cat head.txt body.js >"$target"
wc -c "$target"
