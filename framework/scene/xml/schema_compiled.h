#pragma once
#include <libxml/xmlschemas.h>

#include <memory>

#include "framework/scene/xml/schema.h"

namespace presa::xml {

struct FreeSchema {
  void operator()(xmlSchema* schema) const { xmlSchemaFree(schema); }
};

struct Schema::Compiled {
  std::unique_ptr<xmlSchema, FreeSchema> schema;
};

}  // namespace presa::xml
