// Bundles the page into ../built, which is committed; with --test the tests into test/built.
import { build } from "esbuild";
import { copyFileSync, readdirSync } from "node:fs";

const common = { bundle: true, format: "esm", target: "es2022", logLevel: "warning" };
if (process.argv.includes("--test")) {
  await build({
    ...common,
    entryPoints: readdirSync("test").filter((name) => name.endsWith(".test.ts")).map((name) => `test/${name}`),
    platform: "node",
    outdir: "test/built",
    outExtension: { ".js": ".mjs" },
  });
} else {
  await build({ ...common, entryPoints: ["src/studio.ts"], minify: true, outfile: "../built/studio.js" });
  await build({ ...common, entryPoints: ["src/studio.css"], minify: true, outfile: "../built/studio.css" });
  for (const name of ["index.html", "icon.svg"]) copyFileSync(`src/${name}`, `../built/${name}`);
}
