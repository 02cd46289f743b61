-- Figures by the program lekalo in documents of pandoc:  pandoc --lua-filter lekalo.lua paper.md -o paper.pdf
--
--   ![A ring](ring.yaml){set="r=0.5 R=2" width=84}
--
--   ``` {.lekalo width=60 caption="A circle"}
--   lekalo: 1
--   geometry: { c: { type: circle, radius: 1 } }
--   ```
--
-- `width` is in millimetres. A figure is called after a hash of its scene and options and is made only where it is
-- missing. LEKALO in the environment names the program, LEKALO_FOLDER the folder of figures (lekalo).
local program = os.getenv("LEKALO") or "lekalo"
local folder = os.getenv("LEKALO_FOLDER") or "lekalo"

local function read(name)
  local file = io.open(name, "rb")
  if not file then return nil end
  local text = file:read("a")
  file:close()
  return text
end

local function make_folder()
  os.execute("mkdir -p '" .. folder:gsub("'", "'\\''") .. "'")
end

local function ending()
  return (FORMAT:match("latex") or FORMAT:match("beamer") or FORMAT:match("context")) and "pdf"
    or (FORMAT:match("docx") or FORMAT:match("odt")) and "png" or "svg"
end

-- The name of the figure, made if it is missing.
local function figure(scene, text, attributes)
  local arguments = {"draw", scene, "--quiet"}
  local key = text
  if attributes.width then
    table.insert(arguments, "--width")
    table.insert(arguments, attributes.width)
    key = key .. "|width " .. attributes.width
  end
  for one in (attributes.set or ""):gmatch("%S+") do
    table.insert(arguments, "--set")
    table.insert(arguments, one)
    key = key .. "|set " .. one
  end
  local file = folder .. "/" .. pandoc.utils.sha1(key) .. "." .. ending()
  if not read(file) then
    make_folder()
    table.insert(arguments, "-o")
    table.insert(arguments, file)
    pandoc.pipe(program, arguments, "")
  end
  return file
end

local function rest(attributes)
  local kept = {}
  for name, value in pairs(attributes) do
    if name ~= "set" and name ~= "width" and name ~= "caption" then kept[name] = value end
  end
  return kept
end

function Image(image)
  if not image.src:match("%.ya?ml$") then return nil end
  local text = read(image.src)
  if not text then error("lekalo: there is no scene '" .. image.src .. "'") end
  image.src = figure(image.src, text, image.attributes)
  image.attributes = rest(image.attributes)
  return image
end

function CodeBlock(block)
  if not block.classes:includes("lekalo") then return nil end
  make_folder()
  local scene = folder .. "/" .. pandoc.utils.sha1(block.text) .. ".yaml"
  local file = io.open(scene, "wb")
  file:write(block.text, "\n")
  file:close()
  local caption = block.attributes.caption
  local image = pandoc.Image(caption and {pandoc.Str(caption)} or {}, figure(scene, block.text, block.attributes),
                             caption and "fig:" or "", pandoc.Attr(block.identifier, {}, rest(block.attributes)))
  return pandoc.Para({image})
end
