// Blobs of the page: base64 of a zlib stream.
import { unzlibSync } from "fflate";

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflate(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  if (typeof DecompressionStream === "undefined") return unzlibSync(bytes);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The inflated bytes of the script element `id`. */
export async function readBlob(id: string): Promise<Uint8Array> {
  const text = document.getElementById(id)?.textContent;
  if (text == null) throw new Error(`this page has lost its data (no element ${id})`);
  return inflate(bytesOf(text.trim()));
}
