import assert from "node:assert/strict";
import { test } from "node:test";
import { hashOf, viewOf } from "../src/views";

test("an address names a folder or a file, whatever letters it has", () => {
  for (const name of ["recordings", "networks"] as const)
    for (const path of ["/tmp/a b/ü#?%/out", "out", ""]) assert.deepEqual(viewOf(hashOf(name, path)), { name, path });
  assert.deepEqual(viewOf("#recordings"), { name: "recordings", path: "" });
  assert.deepEqual(viewOf("#networks/%"), { name: "networks", path: "" });
  for (const hash of ["", "#live", "#nonsense"]) assert.deepEqual(viewOf(hash), { name: "live", path: "" });
});
